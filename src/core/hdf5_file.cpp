#include "core/hdf5_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// The value of an attribute that holds a single one of this type; null if it holds something else.
template <class Value>
const Value* single_value(const std::map<std::string, StoredArray>& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return nullptr;
  const auto* values = std::get_if<std::vector<Value>>(&found->second.elements);
  return values != nullptr && values->size() == 1 ? values->data() : nullptr;
}

[[noreturn]] void fail_attribute(const std::string& name, const std::string& expected) {
  throw Hdf5Error("attribute " + name + ": expected " + expected);
}

std::string text_in(const std::map<std::string, StoredArray>& attributes, const std::string& name) {
  const auto* text = single_value<std::string>(attributes, name);
  if (text == nullptr) fail_attribute(name, "a text");
  return *text;
}

/// How many rows of a shape with elements are read at once: about 8 MB.
std::uint64_t rows_at_once(const Shape& shape) {
  constexpr std::uint64_t elements = 1U << 20U;
  const std::uint64_t row = element_count(shape) / (shape.empty() ? 1 : shape[0]);
  return std::max<std::uint64_t>(elements / row, 1);
}

}  // namespace

Hdf5File::Hdf5File(ReaderProcess reader) : reader_(std::move(reader)) {
  reader_.ask<bool>(ReaderRequest::open);
  attributes_ = attributes("/");
}

Hdf5File Hdf5File::open(const std::string& path) {
  return Hdf5File(ReaderProcess(path));
}

Hdf5File Hdf5File::from_image(const std::string& name, std::string_view image) {
  return Hdf5File(ReaderProcess(name, image));
}

bool Hdf5File::has(const std::string& path) const {
  return reader_.ask<bool>(ReaderRequest::has, path);
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  return reader_.ask<std::vector<std::string>>(ReaderRequest::members, group);
}

bool Hdf5File::is_dataset(const std::string& object) const {
  return reader_.ask<std::optional<DatasetLayout>>(ReaderRequest::layout, object).has_value();
}

DatasetLayout Hdf5File::layout(const std::string& dataset) const {
  auto layout = reader_.ask<std::optional<DatasetLayout>>(ReaderRequest::layout, dataset);
  if (!layout) reader_.fail(dataset + ": expected a dataset, found a group or a type");
  return std::move(*layout);
}

Shape Hdf5File::shape(const std::string& dataset) const {
  return layout(dataset).shape;
}

ElementType Hdf5File::element_type(const std::string& dataset) const {
  return layout(dataset).type;
}

std::vector<std::string> Hdf5File::dimensions(const std::string& dataset) const {
  return reader_.ask<std::vector<std::string>>(ReaderRequest::dimensions, dataset);
}

/// `block`: the shape of the rows that are read.
template <class Element>
std::vector<Element> Hdf5File::read_rows(const std::string& dataset, std::uint64_t first,
                                         const Shape& block) const {
  const auto type = static_cast<ElementType>(StoredElements(std::vector<Element>()).index());
  const std::uint64_t rows = block.empty() ? 1 : block[0];
  auto elements = reader_.ask<StoredElements>(ReaderRequest::read, dataset, type, first, rows);
  auto* read = std::get_if<std::vector<Element>>(&elements);
  if (read == nullptr || read->size() != element_count(block))
    reader_.fail("dataset " + dataset + " is damaged");
  return std::move(*read);
}

template <class Element>
std::vector<Element> Hdf5File::read_all(const std::string& dataset) const {
  Shape block = shape(dataset);
  if (element_count(block) == 0) return {};
  const std::uint64_t rows = block.empty() ? 1 : block[0], step = rows_at_once(block);
  if (rows <= step) return read_rows<Element>(dataset, 0, block);
  std::vector<Element> all;
  all.reserve(element_count(block));
  for (std::uint64_t first = 0; first < rows; first += step) {
    block[0] = std::min(step, rows - first);
    std::vector<Element> part = read_rows<Element>(dataset, first, block);
    all.insert(all.end(), std::move_iterator(part.begin()), std::move_iterator(part.end()));
  }
  return all;
}

StoredArray Hdf5File::read(const std::string& dataset) const {
  const DatasetLayout found = layout(dataset);
  switch (found.type) {
    case ElementType::real:
      return {found.shape, read_real(dataset)};
    case ElementType::complex:
      return {found.shape, read_complex(dataset)};
    case ElementType::integer:
      return {found.shape, read_integers(dataset)};
    default:
      return {found.shape, read_texts(dataset)};
  }
}

std::vector<double> Hdf5File::read_real(const std::string& dataset) const {
  return read_all<double>(dataset);
}

std::vector<Complex> Hdf5File::read_complex(const std::string& dataset) const {
  return read_all<Complex>(dataset);
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& dataset) const {
  return read_all<std::int64_t>(dataset);
}

std::vector<std::string> Hdf5File::read_texts(const std::string& dataset) const {
  return read_all<std::string>(dataset);
}

std::vector<Complex> Hdf5File::read_complex_row(const std::string& dataset, std::uint64_t row) const {
  Shape block = shape(dataset);
  if (block.empty() || row >= block[0])
    reader_.fail("dataset " + dataset + " has no row " + std::to_string(row));
  block[0] = 1;
  return read_rows<Complex>(dataset, row, block);
}

std::map<std::string, StoredArray> Hdf5File::attributes(const std::string& object) const {
  return reader_.ask<std::map<std::string, StoredArray>>(ReaderRequest::attributes, object);
}

std::string Hdf5File::text_attribute(const std::string& name) const {
  return text_in(attributes_, name);
}

std::string Hdf5File::text_attribute(const std::string& dataset, const std::string& name) const {
  const auto all = attributes(dataset);
  return all.contains(name) ? text_in(all, name) : "";
}

/// Integers are read as real numbers, too; MATLAB writes every number as a real one.
double Hdf5File::real_attribute(const std::string& name) const {
  if (const auto* integer = single_value<std::int64_t>(attributes_, name))
    return static_cast<double>(*integer);
  const auto* real = single_value<double>(attributes_, name);
  if (real == nullptr) fail_attribute(name, "a number");
  return *real;
}

std::int64_t Hdf5File::integer_attribute(const std::string& name) const {
  if (const auto* integer = single_value<std::int64_t>(attributes_, name)) return *integer;
  constexpr double largest = 9007199254740992.0;  // up to here every whole number is a double
  const double value = real_attribute(name);
  if (!(std::abs(value) <= largest) || value != std::floor(value))
    fail_attribute(name, "a whole number, found " + exact_text(value));
  return static_cast<std::int64_t>(value);
}

std::vector<std::string> Hdf5File::attribute_names() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : attributes_) names.push_back(name);
  return names;
}

}  // namespace eigentrail
