#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/spectrum_distance.hpp"
#include "accuracy/verify/comparisons.hpp"
#include "core/texts.hpp"
#include "eigentrail/stability/permanent_modes.hpp"

namespace eigentrail {
namespace {

/// A real part at a stored point is not zero if it is larger than this times max(|s|, reference).
constexpr double vanishing_real_part = 1e-9;

/// Numbers of eigenvalues at a place, both members of pairs counted. Modes that are zero throughout do not
/// count.
struct Census {
  int all = 0, growing = 0, real = 0;
  int surely_growing = 0, surely_decaying = 0;  ///< beyond their errors
  int hidden = 0;  ///< zero within their errors: whether they are pairs or real is not known

  bool knows_growing() const { return surely_growing + surely_decaying == all; }
};

/// `level`: error of the eigenvalues, as in eigenvalue_errors.
Census census_at(const CheckedFile& file, const PathPosition& place, double level,
                 const std::vector<Permanence>& permanence) {
  const ComplexVector s = file.loci.eigenvalues_at(place);
  const Vector errors = eigenvalue_errors(file.loci, place, s, level, file.accuracy);
  Census census;
  for (Eigen::Index mode = 0; mode < s.size(); ++mode) {
    const double growth = s[mode].real();
    if (!std::isfinite(growth) || permanence[static_cast<std::size_t>(mode)] == Permanence::zero) continue;
    // Where two meet on the real axis each of them is stored, a little beside it.
    const int members = std::abs(s[mode].imag()) <= errors[mode] ? 1 : 2;
    census.all += members;
    census.growing += growth > 0.0 ? members : 0;
    census.real += s[mode].imag() == 0.0 ? 1 : 0;
    census.hidden += std::abs(s[mode]) <= errors[mode] ? 1 : 0;
    census.surely_growing += growth > errors[mode] ? members : 0;
    census.surely_decaying += growth < -errors[mode] ? members : 0;
  }
  return census;
}

/// Whether a mode passes through infinity on a step.
bool has_infinity(const PathStep& step) {
  return std::ranges::find(step.blocks, Chart::reciprocal, &DenseBlock::chart) != step.blocks.end();
}

/// The change of the number of growing eigenvalues that the events say, as the path goes from one stored
/// point to another; empty where the path turns or branches, and where a mode passes through infinity.
std::optional<int> change_by_events(const CheckedFile& file, std::size_t from, std::size_t to) {
  const LociFile& loci = file.loci;
  for (std::size_t step = from; step < to; ++step) {
    if (has_infinity(loci.steps[step])) return std::nullopt;
  }
  int change = 0;
  for (const Event& event : file.events) {
    const auto node = static_cast<std::size_t>(event.node);
    if (node < from || node > to) continue;
    const bool on_axis = event.kind == EventKind::collision && event.direction != 0;
    if (on_axis || is_static(event.kind)) return std::nullopt;
    if (node == from) continue;
    const int members = event.kind == EventKind::flutter ? 2 : event.kind == EventKind::divergence ? 1 : 0;
    change += (loci.p[node] > loci.p[node - 1] ? members : -members) * event.direction;
  }
  return change;
}

/// Whether every mode of a point goes on with the step behind it, and none passes through infinity there.
bool goes_on(const CheckedFile& file, std::size_t step) {
  const ComplexVector s = file.loci.eigenvalues_at(PathPosition{step, 0.0});
  Eigen::Index modes = 0;
  for (const DenseBlock& block : file.loci.steps[step].blocks)
    modes += static_cast<Eigen::Index>(block.modes.size());
  return !has_infinity(file.loci.steps[step]) && modes == (s.array().isFinite()).count();
}

bool has_collision(const CheckedFile& file, std::size_t from, std::size_t to) {
  return std::any_of(file.events.begin(), file.events.end(), [&](const Event& event) {
    const auto node = static_cast<std::size_t>(event.node);
    return node >= from && node <= to && (event.kind == EventKind::collision || is_static(event.kind));
  });
}

std::string between(const CheckedFile& file, std::size_t from, std::size_t to) {
  const auto [low, high] = std::minmax(file.loci.p[from], file.loci.p[to]);
  return "between " + file.at(low) + " and " + short_text(high, 3);
}

void compare_counts(const CheckedFile& file, Comparison& result) {
  const LociFile& loci = file.loci;
  const std::vector<Permanence> permanence = permanence_of_modes(loci, file.accuracy);
  std::optional<std::size_t> known;
  std::vector<Census> counts;
  std::size_t compared = 0;
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    counts.push_back(census_at(file, file.loci.at_node(node), vanishing_real_part, permanence));
    const Census& here = counts.back();
    const Census& before = counts[node > 0 ? node - 1 : 0];
    if (node > 0 && goes_on(file, node - 1) && here.all == before.all && here.real != before.real &&
        here.hidden + before.hidden == 0 && !has_collision(file, node - 1, node))
      result.faults.push_back(between(file, node - 1, node) +
                              " the number of real eigenvalues changes without a collision");
    if (!here.knows_growing()) continue;
    if (known && counts[*known].all == here.all) {
      const std::optional<int> told = change_by_events(file, *known, node);
      const int seen = here.growing - counts[*known].growing;
      compared += told ? 1 : 0;
      if (told && *told != seen)
        result.faults.push_back(between(file, *known, node) +
                                " the number of growing eigenvalues changes by " + std::to_string(seen) +
                                ", by the special points " + std::to_string(*told));
    }
    known = node;
  }
  result.compared = "numbers of growing and of real eigenvalues on " + count_of(compared, "step") +
                    " against the special points";
}

/// Whether p lies between the ends of a range, by more than `margin`.
bool holds(const StableRange& range, double p, double margin) {
  const auto [low, high] = std::minmax(range.from.p, range.to.p);
  return low + margin < p && p < high - margin;
}

/// Whether a mode grows in the middle of a stable range, by the spectrum of the whole model there: it tells
/// far less growth than the dense output does.
bool grows_in_middle(const CheckedFile& file, const FreshSolver& solver, const StableRange& range) {
  if (range.kind != Stability::stable || !range.whole) return false;
  const auto places = file.loci.positions(0.5 * (range.from.p + range.to.p));
  return std::ranges::any_of(places, [&](const PathPosition& place) {
    return std::ranges::any_of(solver.refined_spectrum_at(place), [&](Complex s) {
      const double size = std::abs(s);
      return std::isfinite(size) && size > file.accuracy.reference && s.real() > vanishing_real_part * size;
    });
  });
}

void compare_ranges(const CheckedFile& file, const FreshSolver& solver, Comparison& result) {
  constexpr double accuracy_of_ends = 1e-9;  // share of the range of the parameter
  const LociFile& loci = file.loci;
  const bool ascends = std::is_sorted(loci.p.begin(), loci.p.end());
  if (!loci.ranges || loci.data_errors || (!ascends && !std::is_sorted(loci.p.rbegin(), loci.p.rend())))
    return;
  const double margin = accuracy_of_ends * (loci.highest() - loci.lowest());
  for (const StableRange& range : *loci.ranges) {
    if (grows_in_middle(file, solver, range))
      result.faults.push_back("a mode grows in the middle of the stable range from " + file.at(range.from.p) +
                              " on");
  }
  const std::vector<Permanence> permanence = permanence_of_modes(loci, file.accuracy);
  for (std::size_t step = 0; step < loci.steps.size(); ++step) {
    for (const double t : {0.0, 0.5}) {
      const double p = loci.parameter_at({step, t});
      const double level = t == 0.0 ? vanishing_real_part : file.accuracy.tolerance;
      const Census census = census_at(file, {step, t}, level, permanence);
      const auto is_in = [&](double by) {
        return std::ranges::any_of(*loci.ranges, [&](const auto& range) { return holds(range, p, by); });
      };
      if (census.surely_growing > 0 && is_in(margin))
        result.faults.push_back("a mode grows at " + file.at(p) + ", within a stable range");
      if (census.all > 0 && census.surely_decaying == census.all && file.setup.options.modes.is_all() &&
          !is_in(-margin))
        result.faults.push_back("all modes decay at " + file.at(p) + ", outside the stable ranges");
    }
  }
  result.compared += ", " + count_of(loci.ranges->size(), "stable range") + " against the eigenvalues";
}

}  // namespace

Comparison compare_stability(const CheckedFile& file, const FreshSolver& solver) {
  Comparison result;
  if (!file.has_steps()) return result;
  compare_counts(file, result);
  compare_ranges(file, solver, result);
  return result;
}

}  // namespace eigentrail
