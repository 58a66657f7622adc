#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

#include "accuracy/spectrum_distance.hpp"
#include "accuracy/verify/comparisons.hpp"
#include "core/hdf5_file.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "store/loci_schema.hpp"

namespace eigentrail {
namespace {

struct FileDifferences {
  std::size_t numbers = 0;  ///< that were compared
  std::vector<std::string>
      faults;  ///< per dataset: whether it is missing or longer, and its first difference
  std::set<std::string> different;  ///< names of the datasets of which numbers differ that both files have
};

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

/// What differs in the datasets of the file from `traced`, the bytes of a loci file of a new trace. Datasets
/// that only the first file has do not count: other programs may have added them.
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
      result_.faults.push_back(name + " has " + count_of(stored.size(), "element") + ", in a new trace " +
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

/// Attributes that differ between runs, or hold what other comparisons look at.
bool is_compared(const std::string& attribute) {
  static const std::set<std::string> others{"seconds", "program_version", "scene_path", "blas_kernel"};
  return !attribute.starts_with("count_") && !others.contains(attribute);
}

/// Traces the stored scene as far as the file goes.
TracedFile trace_again(const LociFile& loci) {
  TraceSetup setup = setup_of(loci);
  project_if_large(setup.model, setup.options);
  setup.options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const std::string& status = loci.attribute("status");
  const bool has_ended = status != "running" && status != "interrupted";
  return trace_in_memory(setup, [&](const Checkpoint&, int points) {
    return has_ended || points < static_cast<int>(loci.n_nodes());
  });
}

/// A place that differs by less than this share of the range is the same.
constexpr double same_place = 1e-6;

void compare_labels_with(const LociFile& traced, const CheckedFile& file, Comparison& result) {
  constexpr double both_errors = 4.0;
  const double range = traced.highest() - traced.lowest();
  if (std::abs(file.loci.p.back() - traced.p.back()) > same_place * range)
    result.faults.push_back("the file ends at " + file.at(file.loci.p.back()) + ", a new trace at " +
                            exact_text(traced.p.back()));
  if (file.loci.modes.size() != traced.modes.size())
    result.faults.push_back("the file has " + count_of(file.loci.modes.size(), "mode") + ", a new trace " +
                            std::to_string(traced.modes.size()));
  for (const std::size_t node : file.plain_nodes(100)) {
    const double p = file.loci.p[node];
    const std::vector<PathPosition> places = traced.positions(p);
    if (places.size() != 1) continue;  // the path turns back, or the new trace ends before
    const ComplexVector stored = file.loci.eigenvalues_at(file.loci.at_node(node));
    const ComplexVector s = traced.eigenvalues_at(places.front());
    const Vector errors =
        eigenvalue_errors(traced, places.front(), s, file.accuracy.tolerance, file.accuracy);
    for (Eigen::Index mode = 0; mode < std::min(s.size(), stored.size()); ++mode) {
      if (std::abs(s[mode] - stored[mode]) > both_errors * errors[mode])
        result.faults.push_back("the eigenvalue of " + file.mode_at(mode, p) +
                                " is another one in a new trace");
    }
  }
}

void compare_events_with(const LociFile& traced, const CheckedFile& file, Comparison& result) {
  const double near = same_place * (file.loci.highest() - file.loci.lowest());
  const auto lacks = [&](const std::vector<LociEvent>& events, const LociEvent& wanted) {
    return std::none_of(events.begin(), events.end(), [&](const LociEvent& event) {
      return event.kind == wanted.kind && event.modes == wanted.modes &&
             std::abs(event.parameter - wanted.parameter) <= near;
    });
  };
  const auto name = [&](const LociEvent& event) {
    return event.kind + " of modes " + event.modes + " at " + file.at(event.parameter);
  };
  for (const LociEvent& event : file.loci.events)
    if (lacks(traced.events, event)) result.faults.push_back("a new trace has no " + name(event));
  for (const LociEvent& event : traced.events)
    if (lacks(file.loci.events, event)) result.faults.push_back("a new trace has a " + name(event));
}

void compare_attributes_with(const LociFile& traced, const CheckedFile& file, Comparison& result) {
  for (const auto& [name, text] : traced.attributes) {
    const auto stored = file.loci.attributes.find(name);
    if (!is_compared(name) || (stored != file.loci.attributes.end() && stored->second == text)) continue;
    result.faults.push_back(
        "attribute " + name + " is " +
        (stored == file.loci.attributes.end() ? "missing" : "'" + printable(stored->second) + "'") +
        ", in a new trace '" + printable(text) + "'");
  }
}

}  // namespace

Comparison compare_new_trace(const CheckedFile& file) {
  Comparison result;
  const TracedFile traced = trace_again(file.loci);
  if (traced.bytes.empty()) {
    result.faults.push_back("a new trace finds no first point: " + traced.result.message);
    return result;
  }
  const LociFile other = read_loci_image("new trace", traced.bytes);
  FileDifferences differences = Differences(file, traced.bytes).find();
  const std::size_t computed = differences.different.count("dense_output") +
                               differences.different.count("mode_shape") +
                               differences.different.count("eigenvalue_derivative");
  if (computed < 3) {  // one of them is the same bit for bit: so is the arithmetic
    result.compared = std::to_string(differences.numbers) + " numbers against a new trace, bit for bit";
    result.faults = std::move(differences.faults);
    compare_attributes_with(other, file, result);
    return result;
  }
  compare_labels_with(other, file, result);
  compare_events_with(other, file, result);
  result.compared = "labels and special points against a new trace, which has other rounding errors here";
  return result;
}

}  // namespace eigentrail
