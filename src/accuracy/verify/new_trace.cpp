#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "accuracy/verify/comparisons.hpp"
#include "accuracy/verify/file_differences.hpp"
#include "accuracy/verify/spectrum_errors.hpp"
#include "accuracy/verify/stored_scene.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"

namespace eigentrail {
namespace {

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
    result.faults.push_back("the file has " + count_text(file.loci.modes.size(), "mode") + ", a new trace " +
                            std::to_string(traced.modes.size()));
  for (const std::size_t node : file.plain_nodes(100)) {
    const double p = file.loci.p[node];
    const std::vector<PathPosition> places = traced.positions(p);
    if (places.size() != 1) continue;  // the path turns back, or the new trace ends before
    const ComplexVector stored = file.loci.eigenvalues_at(file.node(node));
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
  FileDifferences differences = file_differences(file, traced.bytes);
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
