#include "properties/run_family.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "properties/place_rounding.hpp"

namespace eigentrail::test {
namespace {

constexpr int random_samples = 40;
constexpr double allowed_error = 4.0;  ///< tolerances, as for the hard cases

/// Parameters at which labels are compared: a grid, and the middle between neighbouring special points, where
/// modes are distinguished best.
std::vector<double> label_parameters(const HardCase& hard_case) {
  const auto [low, high] = std::minmax(hard_case.from, hard_case.to);
  constexpr int n = 199;
  std::vector<double> parameters;
  for (int i = 0; i < n; ++i) parameters.push_back(low + (high - low) * (i + 0.5) / n);
  double last = low;
  for (const SpecialPoint& point : hard_case.special) {
    parameters.push_back(0.5 * (last + point.parameter));
    last = point.parameter;
  }
  parameters.push_back(0.5 * (last + high));
  std::sort(parameters.begin(), parameters.end());
  return parameters;
}

/// Whether the eigenvalue may belong to one of the blocks: no other block has one that is clearly nearer.
bool belongs_to(const std::vector<LabelledMode>& modes, const std::vector<int>& blocks, Complex s) {
  double own = INFINITY;
  double other = INFINITY;
  for (const LabelledMode& mode : modes) {
    const bool is_own = std::find(blocks.begin(), blocks.end(), mode.family) != blocks.end();
    double& nearest = is_own ? own : other;
    nearest = std::min(nearest, std::abs(mode.s - s));
  }
  return !(own > 10.0 * other);
}

/// The events that name other modes than those that meet there.
std::vector<std::string> wrong_modes(const PlantedFamily& family, const RecordedTrace& trace,
                                     const EventComparison& events) {
  std::vector<std::string> wrong;
  for (std::size_t i = 0; i < family.special.size(); ++i) {
    if (events.event_of[i] < 0) continue;
    const Event& event = trace.result.events[static_cast<std::size_t>(events.event_of[i])];
    const auto values = trace.all_eigenvalues_at(family.special[i].parameter);
    const auto modes = family.labelled(family.special[i].parameter);
    const bool right = std::all_of(event.modes.begin(), event.modes.end(), [&](int mode) {
      return values.empty() || belongs_to(modes, family.meeting[i], values.front()[mode]);
    });
    // A pair is one mode. Two modes take part unless one pair crosses the imaginary axis or meets its
    // conjugate.
    const std::string& kind = family.special[i].kind;
    const bool alone = kind == "flutter" || kind == "divergence";
    const bool own_conjugate = kind == "collision" && family.special[i].s.imag() == 0.0;
    const std::size_t least = alone || own_conjugate ? 1 : 2;
    const std::size_t most = alone ? 1 : 2;
    const bool counted = event.modes.size() >= least && event.modes.size() <= most;
    if (!right || !counted) wrong.push_back(event_line(event));
  }
  return wrong;
}

}  // namespace

std::string FamilyReport::problems() const {
  std::ostringstream text;
  text.precision(4);
  if (!completed) text << "ended early: " << message << "; ";
  if (!(accuracy.worst_error <= allowed_error)) {
    text << "error of " << accuracy.worst_error << " tolerances at ";
    text.precision(12);
    text << accuracy.worst_at << "; ";
  }
  if (labels.wrong > 0) {
    text << labels.wrong << " of " << labels.labels << " certified labels wrong (" << labels.wrong_places[0]
         << "); ";
  }
  for (const std::string& event : events.missing) text << "missing " << event << "; ";
  for (const std::string& event : events.invented) text << "invented " << event << "; ";
  for (const std::string& event : wrong_modes) text << "wrong modes in " << event << "; ";
  return text.str();
}

RunSetting setting_of(std::uint64_t seed) {
  std::mt19937_64 engine(seed + 1000003);
  RunSetting setting;
  const double tolerances[] = {1e-4, 1e-6, 1e-8};
  setting.tolerance = tolerances[engine() % 3];
  setting.reversed = engine() % 2 == 0;
  // Half of the seeds with a first step of 1e-3 to 0.3 of the range, else the program's own.
  const double part = static_cast<double>(engine() >> 11) * 0x1p-53;
  if (engine() % 2 == 0) setting.first_step = 1e-3 * std::pow(300.0, part);
  return setting;
}

FamilyReport run_family(const PlantedFamily& family, const RunSetting& setting) {
  HardCase hard_case = family.as_case();
  for (SpecialPoint& point : hard_case.special) point.rounding = place_rounding(family.matrices, point);
  const RecordedTrace trace = trace_case(hard_case, setting);
  FamilyReport report;
  report.completed = trace.result.status == TraceStatus::completed;
  report.message = trace.result.message;
  if (trace.steps.empty()) return report;
  std::vector<Sample> samples;
  for (const double p : sample_parameters(hard_case, random_samples))
    samples.push_back(sample_at(hard_case, p));
  report.accuracy = measure_accuracy(samples, trace, setting.tolerance);
  report.events = compare_events(hard_case, trace, setting.tolerance);
  report.wrong_modes = wrong_modes(family, trace, report.events);
  std::vector<LabelledPlace> labelled;
  for (const double p : label_parameters(hard_case)) labelled.push_back({p, family.labelled(p)});
  count_labels(trace, labelled, 0, report.labels);
  return report;
}

}  // namespace eigentrail::test
