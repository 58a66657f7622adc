#include "core/hdf5_file.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

std::size_t size_of(const StoredArray& array) {
  return std::visit([](const auto& list) { return list.size(); }, array.elements);
}

/// Integers count as real numbers, and whole real numbers as integers. Nothing for other types.
template <class To, class From>
std::optional<To> converted(const From& value) {
  if constexpr (std::is_same_v<To, double> && std::is_same_v<From, std::int64_t>)
    return static_cast<double>(value);
  if constexpr (std::is_same_v<To, std::int64_t> && std::is_same_v<From, double>) {
    constexpr double largest = 9007199254740992.0;  // up to here every whole number is a double
    if (std::abs(value) <= largest && value == std::floor(value)) return static_cast<std::int64_t>(value);
  }
  return std::nullopt;
}

template <class Element>
constexpr const char* name_of_type = std::is_same_v<Element, double>         ? "real numbers"
                                     : std::is_same_v<Element, Complex>      ? "complex numbers"
                                     : std::is_same_v<Element, std::int64_t> ? "whole numbers"
                                                                             : "texts";

}  // namespace

Hdf5File::Hdf5File(const std::string& name, ReaderRequest request, const std::string& what) : reader_(name) {
  reader_.ask<bool>(request, what);
  attributes_ = attributes("/");
}

Hdf5File Hdf5File::open(const std::string& path) {
  try {
    require_plain_file(path);
  } catch (const InputError& error) {
    throw Hdf5Error(error.what());
  }
  return {path, ReaderRequest::open, path};
}

Hdf5File Hdf5File::from_image(const std::string& name, std::string_view image) {
  return {name, ReaderRequest::open_image, std::string(image)};
}

bool Hdf5File::has(const std::string& path) const {
  return reader_.ask<bool>(ReaderRequest::has, path);
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  return reader_.ask<std::vector<std::string>>(ReaderRequest::members, group);
}

Shape Hdf5File::shape(const std::string& dataset) const {
  const std::optional<StoredArray> none = rows(dataset, 0, 0);
  if (!none) fail(dataset + ": expected a dataset, found a group or a type");
  return none->shape;
}

std::optional<StoredArray> Hdf5File::rows(const std::string& object, std::uint64_t first,
                                          std::uint64_t count) const {
  return reader_.ask<std::optional<StoredArray>>(ReaderRequest::read, object, first, count);
}

std::optional<StoredArray> Hdf5File::read(const std::string& object) const {
  std::optional<StoredArray> all = rows(object, 0, max_elements);
  if (!all) return all;
  const std::uint64_t count = element_count(all->shape);
  std::size_t before = 0;
  while (size_of(*all) > before && size_of(*all) < count) {
    before = size_of(*all);
    std::optional<StoredArray> part = rows(object, before / (count / all->shape[0]), max_elements);
    const auto append = [](auto& to, auto& from) {
      if constexpr (std::is_same_v<decltype(to), decltype(from)>)
        to.insert(to.end(), std::move_iterator(from.begin()), std::move_iterator(from.end()));
    };
    if (part) std::visit(append, all->elements, part->elements);
  }
  if (size_of(*all) != count) fail("dataset " + object + " is damaged");
  return all;
}

template <class Element>
std::vector<Element> Hdf5File::elements(std::optional<StoredArray> array, const std::string& name) const {
  if (!array) fail(name + ": expected a dataset, found a group or a type");
  if (auto* same = std::get_if<std::vector<Element>>(&array->elements)) return std::move(*same);
  std::vector<Element> result;
  const auto add_all = [&](const auto& list) {
    for (const auto& value : list) {
      const std::optional<Element> element = converted<Element>(value);
      if (!element) fail(name + ": expected " + name_of_type<Element>);
      result.push_back(*element);
    }
  };
  std::visit(add_all, array->elements);
  return result;
}

std::vector<double> Hdf5File::read_real(const std::string& dataset) const {
  return elements<double>(read(dataset), "dataset " + dataset);
}

std::vector<Complex> Hdf5File::read_complex(const std::string& dataset) const {
  return elements<Complex>(read(dataset), "dataset " + dataset);
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& dataset) const {
  return elements<std::int64_t>(read(dataset), "dataset " + dataset);
}

std::vector<std::string> Hdf5File::read_texts(const std::string& dataset) const {
  return elements<std::string>(read(dataset), "dataset " + dataset);
}

std::vector<Complex> Hdf5File::read_complex_row(const std::string& dataset, std::uint64_t row) const {
  return elements<Complex>(rows(dataset, row, 1), "dataset " + dataset);
}

std::map<std::string, StoredArray> Hdf5File::attributes(const std::string& object) const {
  return reader_.ask<std::map<std::string, StoredArray>>(ReaderRequest::attributes, object);
}

template <class Element>
Element Hdf5File::attribute(const std::map<std::string, StoredArray>& attributes,
                            const std::string& name) const {
  const auto found = attributes.find(name);
  if (found == attributes.end()) fail("has no attribute " + name);
  const std::vector<Element> values = elements<Element>(found->second, "attribute " + name);
  if (values.size() != 1) fail("attribute " + name + ": expected a single value");
  return values[0];
}

std::string Hdf5File::text_attribute(const std::string& name) const {
  return attribute<std::string>(attributes_, name);
}

double Hdf5File::real_attribute(const std::string& name) const {
  return attribute<double>(attributes_, name);
}

std::int64_t Hdf5File::integer_attribute(const std::string& name) const {
  return attribute<std::int64_t>(attributes_, name);
}

std::string Hdf5File::text_attribute(const std::string& dataset, const std::string& name) const {
  const auto all = attributes(dataset);
  return all.contains(name) ? attribute<std::string>(all, name) : "";
}

std::map<std::string, std::string> Hdf5File::attribute_texts() const {
  std::map<std::string, std::string> texts;
  for (const auto& [name, value] : attributes_) {
    if (size_of(value) != 1) continue;
    if (const auto* text = std::get_if<std::vector<std::string>>(&value.elements))
      texts[name] = text->front();
    if (const auto* real = std::get_if<std::vector<double>>(&value.elements))
      texts[name] = exact_text(real->front());
    if (const auto* integer = std::get_if<std::vector<std::int64_t>>(&value.elements))
      texts[name] = std::to_string(integer->front());
  }
  return texts;
}

}  // namespace eigentrail
