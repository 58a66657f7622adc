#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/spectrum_distance.hpp"
#include "accuracy/verify/comparisons.hpp"
#include "continuation/events/criterion.hpp"
#include "core/texts.hpp"
#include "eigentrail/continuation/event_kinds.hpp"

namespace eigentrail {
namespace {

/// Relative rounding error of what k equal eigenvalues follow from: each is known to its k-th root.
constexpr double rounding_of_meeting = 1e-13;
/// Places of special points are accurate to this share of the range, with a margin.
constexpr double accuracy_of_place = 1e-9;

/// The place of an event on the step that ends at its point; empty if the step does not hold it.
std::optional<PathPosition> place_of(const LociFile& loci, const Event& event) {
  if (loci.steps.empty()) return std::nullopt;
  const auto step = static_cast<std::size_t>(std::max(event.node - 1, 0));
  const std::vector<double> found = step_positions(loci.steps[step], event.p);
  if (!found.empty()) return PathPosition{step, found.front()};
  // The exceptional point of a veering is beside the path.
  const std::vector<PathPosition> anywhere = loci.positions(event.p);
  if (event.kind == EventKind::veering && !anywhere.empty()) return anywhere.front();
  // Rounding may have moved it off the end of the step.
  const double from_left = std::abs(event.p - loci.p[step]);
  const double from_right = std::abs(event.p - loci.p[step + 1]);
  if (std::min(from_left, from_right) <= accuracy_of_place * (loci.highest() - loci.lowest()))
    return PathPosition{step, from_left < from_right ? 0.0 : 1.0};
  return std::nullopt;
}

/// Number of eigenvalues of the spectrum that an event needs at its eigenvalue.
std::size_t multiplicity(EventKind kind) {
  if (kind == EventKind::veering || kind == EventKind::fold) return 0;  // beside the path; of the equilibrium
  return kind == EventKind::collision || kind == EventKind::crossing ? 2 : 1;
}

/// How far the eigenvalues of an event may be from it, 1/s.
double allowed_distance(const CheckedFile& file, const Event& event, const PathPosition& place,
                        bool is_large) {
  constexpr double zero = 1e-3;        // in units of the reference
  constexpr double branch_zero = 0.1;  // likewise: the place is that of the equilibrium
  if (event.kind == EventKind::branch_point || event.kind == EventKind::cusp)
    return branch_zero * file.accuracy.reference;
  if (event.s == 0.0) return zero * file.accuracy.reference;
  double allowed = file.accuracy.tolerance;
  if (event.kind == EventKind::collision) {
    const double roots = std::max(2.0 * static_cast<double>(event.modes.size()), 2.0);
    allowed = std::pow(is_large ? allowed : rounding_of_meeting, 1.0 / roots);
  }
  allowed *= file.scale_of(event.s);
  const Vector errors =
      eigenvalue_errors(file.loci, place, file.loci.eigenvalues_at(place), 0.0, file.accuracy);
  for (const int mode : event.modes) allowed = std::max(allowed, errors[mode]);
  return allowed;
}

/// Whether so many eigenvalues of a spectrum are as near to s.
bool holds(const std::vector<Complex>& spectrum, Complex s, std::size_t count, double allowed) {
  const std::vector<Complex> all = with_conjugates(spectrum);
  return static_cast<std::size_t>(std::count_if(
             all.begin(), all.end(), [&](Complex value) { return std::abs(value - s) <= allowed; })) >= count;
}

/// The condition of the kind, as far as it is one on the eigenvalue; empty if it holds.
std::string broken_condition(const CheckedFile& file, const Event& event, std::size_t step) {
  const LociFile& loci = file.loci;
  constexpr double rounding = 1e-8;
  const double scale = file.scale_of(event.s);
  switch (event.kind) {
    case EventKind::flutter:
      return std::abs(event.s.real()) <= rounding * scale ? "" : "its real part is not zero";
    case EventKind::divergence:
      return std::abs(event.s) <= rounding * scale ? "" : "its eigenvalue is not zero";
    case EventKind::fold: {
      const std::size_t node = std::min(step + 1, loci.n_nodes() - 2);
      return (loci.p[node] - loci.p[node - 1]) * (loci.p[node + 1] - loci.p[node]) < 0.0
                 ? ""
                 : "the path does not turn back";
    }
    case EventKind::extremum:
      return std::abs(event.value + event.s.real() / std::abs(event.s)) <= rounding
                 ? ""
                 : "its value is not the damping ratio";
    default:
      break;
  }
  const std::optional<Criterion> criterion = criterion_of(event);
  if (!criterion) return "";
  const double value =
      criterion_value(*criterion, event.s, file.setup.options.events,
                      file.setup.model->description().parameters, file.setup.parameters_at(event.p));
  return std::abs(value) <= rounding * scale
             ? ""
             : "its eigenvalue has not the value " + short_text(event.value, 3);
}

std::string fault_of(const CheckedFile& file, const Event& event, FreshSolver& solver) {
  const std::optional<PathPosition> place = place_of(file.loci, event);
  if (!place) return "the step before its point does not hold it";
  if (std::string broken = broken_condition(file, event, place->step); !broken.empty()) return broken;
  const std::size_t count = multiplicity(event.kind);
  if (count == 0) return "";
  const double allowed = allowed_distance(file, event, *place, solver.is_of_large_model());
  const std::vector<Complex> exact = solver.spectrum_at(*place, file.loci.eigenvalues_at(*place));
  if (exact.empty() && event.kind == EventKind::branch_point) return "";  // singular there
  if (holds(exact, event.s, count, allowed)) return "";
  if (holds(solver.refined_spectrum_at(*place, ComplexVector{{event.s}}), event.s, count, allowed)) return "";
  return count == 1 ? "the spectrum has no such eigenvalue there"
                    : "no two eigenvalues of the spectrum meet there";
}

}  // namespace

Comparison compare_events(const CheckedFile& file, FreshSolver& solver) {
  Comparison result;
  for (const Event& event : file.events) {
    const std::string fault = fault_of(file, event, solver);
    if (!fault.empty())
      result.faults.push_back(event_name(event.kind) + " at " + file.at(event.p) + ": " + fault);
  }
  result.compared = count_of(file.events.size(), "special point") + " against the spectrum there";
  return result;
}

}  // namespace eigentrail
