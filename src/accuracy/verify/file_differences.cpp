#include "accuracy/verify/file_differences.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/text.hpp"
#include "store/loci_schema.hpp"

namespace eigentrail {
namespace {

template <class Element>
bool is_same(const Element& a, const Element& b) {
  return a == b;
}
bool is_same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}
bool is_same(Complex a, Complex b) {
  return is_same(a.real(), b.real()) && is_same(a.imag(), b.imag());
}

std::string text_of(double value) {
  return exact_text(value);
}
std::string text_of(Complex value) {
  return exact_text(value.real()) + (value.imag() < 0.0 ? " - " : " + ") +
         exact_text(std::abs(value.imag())) + "j";
}
std::string text_of(std::int64_t value) {
  return std::to_string(value);
}
std::string text_of(const std::string& value) {
  return "'" + printable(value) + "'";
}

/// "[3, 1]", indices from 0 as in h5py.
std::string indices_text(const Shape& shape, std::size_t index) {
  std::string text = "]";
  for (std::size_t d = shape.size(); d-- > 0;) {
    text = (d > 0 ? ", " : "[") + std::to_string(index % shape[d]) + text;
    index /= shape[d];
  }
  return text;
}

class Differences {
 public:
  Differences(const CheckedFile& file, std::string_view traced)
      : file_(file),
        stored_(Hdf5File::open(file.loci.path)),
        traced_(Hdf5File::from_image("new trace", traced)) {
    for (const LociDataset& dataset : growing_datasets(*file.setup.model, file.setup.options))
      rows_[dataset.name] = dataset.dimensions.front();
  }

  FileDifferences find() {
    for (const std::string& name : traced_.members("/")) {
      if (!stored_.has(name))
        result_.faults.push_back(name + " is missing");
      else
        compare_elements(name);
    }
    return std::move(result_);
  }

 private:
  void compare_elements(const std::string& name) {
    const std::optional<StoredArray> traced = traced_.read(name);
    if (!traced) return;  // a type
    const std::optional<StoredArray> stored = stored_.read(name);
    const auto compare_with = [&](const auto& expected) {
      const auto* found = stored ? std::get_if<std::decay_t<decltype(expected)>>(&stored->elements) : nullptr;
      if (found != nullptr)
        compare(name, {stored->shape, traced->shape}, *found, expected);
      else
        result_.faults.push_back(name + " has elements of another type than in a new trace");
    };
    std::visit(compare_with, traced->elements);
  }

  /// `shapes`: of the dataset in the file, and in a new trace.
  template <class Element>
  void compare(const std::string& name, const std::pair<Shape, Shape>& shapes,
               const std::vector<Element>& stored, const std::vector<Element>& traced) {
    result_.numbers += stored.size();
    const Shape& shape = shapes.first;
    if (shape != shapes.second)
      result_.faults.push_back(name + " has " + count_text(stored.size(), "element") + ", in a new trace " +
                               std::to_string(traced.size()));
    const auto common = static_cast<std::ptrdiff_t>(std::min(stored.size(), traced.size()));
    const auto [a, b] = std::mismatch(stored.begin(), stored.begin() + common, traced.begin(),
                                      [](const Element& x, const Element& y) { return is_same(x, y); });
    if (a == stored.begin() + common) return;
    result_.different.insert(name);
    const auto index = static_cast<std::size_t>(a - stored.begin());
    result_.faults.push_back(name + indices_text(shape, index) +
                             place_text(name, index / (stored.size() / shape[0])) + " is " + text_of(*a) +
                             ", in a new trace " + text_of(*b));
  }

  /// Where on the path a row of a dataset is.
  std::string place_text(const std::string& name, std::size_t row) const {
    const auto dimension = rows_.find(name);
    if (dimension == rows_.end()) return "";
    if (dimension->second == "node") return " (" + file_.at(file_.loci.p[row]) + ")";
    if (dimension->second == "step") return " (behind " + file_.at(file_.loci.p[row]) + ")";
    if (dimension->second != "event") return "";
    const LociEvent& event = file_.loci.events[row];
    return " (" + event.kind + " at " + file_.at(event.parameter) + ")";
  }

  const CheckedFile& file_;
  Hdf5File stored_, traced_;
  std::map<std::string, std::string> rows_;  ///< first dimension of each dataset
  FileDifferences result_;
};

}  // namespace

FileDifferences file_differences(const CheckedFile& file, std::string_view traced) {
  return Differences(file, traced).find();
}

}  // namespace eigentrail
