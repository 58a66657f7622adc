#include "continuation/events/nearby_mode.hpp"

#include <cmath>

#include "continuation/tracks/members.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// Relative distance of an eigenvalue of a block from the others above which it is computed as a single mode.
/// This costs less and is more accurate; at smaller distances the eigenvectors are ill-conditioned.
constexpr double distinct_share = 1e-3;
/// As a share of the distance to the nearest other eigenvalue: if the single mode differs from its prediction
/// by more, the corrector may have converged to the other one.
constexpr double moved_too_far = 0.1;

/// The point at distance h with one eigenvalue of a block as a single mode. Empty for a track that is a
/// single mode anyway, and where the other eigenvalues are too close.
std::optional<SolvedPoint> solve_alone(const PointSolver& solver, const TracksAt& base, Complex expected,
                                       double h) {
  if (base.tracks.front()->size() == 1) return std::nullopt;
  Prediction prediction = solver.predict(base, h);
  const ComplexVector roots = pair_eigenvalues(prediction.pairs.front());
  const Eigen::Index nearest = nearest_root(roots, expected);
  const Complex root = roots[nearest];
  const double gap = distance_from_others(roots, {static_cast<int>(nearest)});
  if (!(gap > distinct_share * std::abs(root))) return std::nullopt;
  prediction.pairs.front() = part_of(prediction.pairs.front(), roots, {static_cast<int>(nearest)});
  std::optional<SolvedPoint> there = solver.solve(prediction, base.node.basis.T[0]);
  if (there && !(std::abs(there->node.tracks.front().roots[0] - root) <= moved_too_far * gap)) there.reset();
  return there;
}

/// The product of an eigenvalue with its partner, as a mode; the mean where the product stays zero, with a
/// rigid-body motion.
std::optional<NearbyMode> product_with_partner(const RoundingThresholds& thresholds,
                                               std::optional<SolvedPoint> there, Complex expected) {
  if (!there) return std::nullopt;
  const Track& track = there->node.tracks.front();
  const auto root = static_cast<int>(nearest_root(track.roots, expected));
  const int partner = partner_of_root(track, root);
  if (partner < 0) return std::nullopt;
  const std::vector<ComplexMatrix> part = part_series(track.series.Lambda, roots_of(track, {root, partner}));
  if (part.size() < 2) return std::nullopt;
  const ComplexVector product = product_series(part);
  const double rounding = thresholds.entries * track.pair.rounding;
  const bool stays_zero = std::abs(product[0]) <= rounding * part[0].norm() &&
                          std::abs(product[1]) <= rounding * (part[0].norm() + part[1].norm());
  const Complex s = track.roots[root];
  const double gap = std::abs(s - track.roots[partner]);
  return NearbyMode{std::move(*there), s, stays_zero ? mean_series(part) : product, gap, stays_zero};
}

}  // namespace

int partner_of_root(const Track& track, int root) {
  if (!track.pair.is_real) return -1;
  const Complex s = track.roots[root];
  int partner = -1;
  for (int i = 0; i < static_cast<int>(track.size()); ++i) {
    const Complex other = track.roots[i];
    const bool fits = s.imag() == 0.0 ? other.imag() == 0.0 : other == std::conj(s);
    if (i == root || !fits) continue;
    if (partner < 0 || std::abs(other - s) < std::abs(track.roots[partner] - s)) partner = i;
  }
  return partner;
}

Complex upper_member(Complex mu, Chart chart) {
  return is_lower(mu, chart) ? std::conj(mu) : mu;
}

std::optional<NearbyMode> look_at_mode(const PointSolver& solver, const PathNode& left, std::size_t track,
                                       Complex expected, double h, ModeFunction wanted) {
  const TracksAt base = one_track(left, track);
  if (wanted == ModeFunction::product)
    return product_with_partner(solver.problem().thresholds.rounding, solver.follow(base, h), expected);
  std::optional<SolvedPoint> beside = solve_alone(solver, base, expected, h);
  if (!beside) beside = solver.follow(base, h);
  if (!beside) return std::nullopt;
  const Track& there = beside->node.tracks.front();
  const Chart chart = there.pair.chart;
  const Eigen::Index nearest = nearest_root(there.roots, expected);
  Complex s = there.roots[nearest];
  ComplexVector series = root_series(there.functions, s);
  if (const auto single =
          separate(solver.problem(), beside->node, there, {static_cast<int>(nearest)}, solver.counts())) {
    series = single->functions.row(0).transpose();
    series[0] +=
        eigenvalue_remainder(PencilAtPoint(beside->node.pencil.of(single->pair.part), chart), single->pair);
    s = series[0];
  }
  const bool is_mean = wanted == ModeFunction::pair_mean && there.pair.is_real && there.size() == 2;
  if (is_mean) {
    // The real part of a complex pair is the mean of the block, smooth also where the pair is defective.
    series = mean_series(there.series.Lambda);
    s.real(series[0].real());
  }
  if (upper_member(s, chart) != s) {
    s = std::conj(s);
    series = series.conjugate().eval();
  }
  const bool are_one = there.size() == 2 && there.functions.row(1).isZero(0.0);
  const double gap = there.size() > 1 && !are_one ? least_gap(there.roots) : INFINITY;
  return NearbyMode{std::move(*beside), s, std::move(series), gap, is_mean};
}

}  // namespace eigentrail
