#include "continuation/events/step_checks.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Of the growing eigenvalues when p increases over the event; empty for folds and branch points, where the
/// number depends on the path.
std::optional<int> change_at(const Event& event) {
  switch (event.kind) {
    case EventKind::flutter:
      return 2 * event.direction;
    case EventKind::divergence:
      return event.direction;
    case EventKind::fold:
    case EventKind::branch_point:
      return std::nullopt;
    default:
      return 0;
  }
}

/// Whether a real eigenvalue passes infinity on the step: 1/s passes zero, and s changes its sign.
bool passes_infinity(const Step& step) {
  const auto positive = [](const Track& track) { return (track.roots.array().real() > 0.0).count(); };
  for (std::size_t i = 0; i < step.left->tracks.size(); ++i) {
    const Track& left = step.left->tracks[i];
    if (left.pair.chart == Chart::reciprocal && positive(left) != positive(step.right.tracks[i])) return true;
  }
  return false;
}

/// Number of guard modes that a step takes in or lets go. A real mode that meets one is one complex pair with
/// it, and where guard modes cross the axis is not looked for: each may change the number of growing
/// eigenvalues by one.
int guards_that_change(const Step& step) {
  const auto guards = [](const Track& track) {
    return static_cast<int>(std::count(track.modes.begin(), track.modes.end(), Track::guard));
  };
  int changes = 0;
  for (std::size_t i = 0; i < step.left->tracks.size(); ++i)
    changes += std::abs(guards(step.right.tracks[i]) - guards(step.left->tracks[i]));
  return changes;
}

/// Number of followed eigenvalues with Re s > 0, pairs counted twice. Empty where one cannot be told from
/// zero, or is infinite.
std::optional<int> growing_eigenvalues(const EventSearch& search, const PathNode& node) {
  int count = 0;
  for (const Track& track : node.tracks) {
    const Vector errors = rounding_of_roots(track, search.thresholds().rounding);
    for (Eigen::Index i = 0; i < track.size(); ++i) {
      if (track.modes[static_cast<std::size_t>(i)] == Track::guard) continue;
      const Complex mu = track.roots[i];
      if (std::abs(mu.real()) <= errors[i]) return std::nullopt;
      // A real block holds the conjugates itself.
      if (mu.real() > 0.0) count += track.pair.is_real || mu.imag() == 0.0 ? 1 : 2;
    }
  }
  return count;
}

/// Safety factor on the bounds of rounding errors.
constexpr double overlooked_rounding_margin = 10.0;

Eigen::Index count_real(const ComplexVector& roots) {
  return (roots.array().imag() == 0.0).count();
}

/// Number of real eigenvalues of a block; empty where two are no farther apart than they are known. Many that
/// nearly coincide are known to a high root of rounding only, and those of rigid-body motions to what
/// rounding of a stiffness leaves that is large beside them.
std::optional<Eigen::Index> count_real(const Track& track, const ComplexVector& functions,
                                       const ComplexVector& roots, const RoundingThresholds& thresholds) {
  const Vector own = overlooked_rounding_margin * function_rounding(track.pair.Lambda);
  const Vector of_entries = function_rounding(track.pair.Lambda, thresholds.entries * track.pair.rounding);
  if (!are_told_apart(functions, roots, own.cwiseMax(of_entries))) return std::nullopt;
  return count_real(roots);
}

/// The same of a track at the left end of a step. Where eigenvalues coincide there, they are looked at a
/// little behind it; where rounding hides them, they were solved for.
std::optional<Eigen::Index> count_real_behind(const Track& left, const RoundingThresholds& thresholds) {
  if (left.departure && left.hidden_within > 0.0) return count_real(left.departure->roots);
  const ComplexVector begin =
      evaluate_series(left.functions, left.departure ? left.departure->distance : 0.0);
  return count_real(left, begin, block_roots(begin), thresholds);
}

}  // namespace

std::optional<std::string> unexplained_growth(const EventSearch& search, const Step& step) {
  if (search.frame().plane || passes_infinity(step)) return std::nullopt;
  const std::optional<int> before = growing_eigenvalues(search, *step.left);
  const std::optional<int> behind = growing_eigenvalues(search, step.right);
  if (!before || !behind) return std::nullopt;
  const auto [low, high] = std::minmax(step.left->p, step.right.p);
  int change = 0;
  for (const Event& event : search.log.events) {
    if (event.p < low || event.p > high) continue;
    const std::optional<int> here = change_at(event);
    if (!here) return std::nullopt;  // also where the step begins there
    if (event.p > low) change += *here;
  }
  const int seen = step.right.p > step.left->p ? *behind - *before : *before - *behind;
  if (std::abs(seen - change) <= guards_that_change(step)) return std::nullopt;
  return "between " + place_text(search.options, low) + " and " + short_text(high, 12) +
         " the number of eigenvalues with Re s > 0 changes by " + std::to_string(seen) +
         ", by the events that were found by " + std::to_string(change) + "; see verify";
}

bool overlooks_collision(const Step& step, const RoundingThresholds& thresholds) {
  for (std::size_t i = 0; i < step.left->tracks.size(); ++i) {
    const Track& left = step.left->tracks[i];
    const Track& right = step.right.tracks[i];
    if (step.meets(i) || !left.pair.is_real || left.size() < 2) continue;
    const auto before = count_real_behind(left, thresholds);
    const auto behind = count_real(right, right.functions.col(0), right.roots, thresholds);
    if (before && behind && *before != *behind) return true;
  }
  return false;
}

}  // namespace eigentrail
