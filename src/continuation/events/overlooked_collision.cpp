#include "continuation/events/overlooked_collision.hpp"

#include <cmath>
#include <optional>

#include "core/matrix_series.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

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
