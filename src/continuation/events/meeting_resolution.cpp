#include "continuation/events/meeting_resolution.hpp"

#include <algorithm>
#include <cmath>

#include "core/matrix_series.hpp"
#include "eigentrail/modes/block_parts.hpp"

namespace eigentrail {
namespace {

/// Safety factor on estimates of rounding errors.
constexpr double resolution_rounding_margin = 10.0;
/// The discriminant of a part that is not a multiple of the unit matrix has an error of about this many times
/// the error of Lambda times the norm of the centred part.
constexpr double error_factor = 4.0;

/// Error of a crossing, at which the part is a multiple of the unit matrix. Beside it the centred part is
/// h N + E with an error E of Lambda, and singular where h is at most |E| |N^-1| = |E| |N| / |det N|; -det N
/// is the curvature of the discriminant. The motion of the mean of the two does not count.
double error_of_crossing(const std::vector<ComplexMatrix>& part, double lambda, double curvature) {
  if (part.size() < 2) return lambda;
  return curvature > 0.0 ? lambda * centred(part[1]).norm() / curvature : 0.0;
}

/// Error of Lambda as it is seen where symmetry of the spectrum decides on the discriminant of two: what
/// rounding leaves of its imaginary part. Zero where nothing is known of it.
double observed_error(const Track& track, const ComplexVector& discriminant) {
  if (track.size() != 2) return 0.0;
  const std::vector<ComplexMatrix>& Lambda = track.series.Lambda;
  const ComplexVector difference = discriminant_series(Lambda, 1) - discriminant;
  double error = 0.0;
  for (Eigen::Index k = 0; k < 2; ++k) {
    if (difference[k] == 0.0) continue;
    const double size = centred(Lambda[static_cast<std::size_t>(k)]).norm();
    error = std::max(error, std::abs(difference[k]) / (error_factor * size));
  }
  return resolution_rounding_margin * error;
}

}  // namespace

PartRounding rounding_of(const Track& track, const std::vector<ComplexMatrix>& part) {
  // The condition refers to norms of the pencil's matrices. It is far too large where the entries of these
  // differ by orders of magnitude, and is therefore bounded.
  constexpr double worst_condition = 100.0;
  constexpr double unit_error = 4e-15;  // relative, for a condition of one: some twenty machine epsilons
  const double condition = std::clamp(track.pair.condition, 1.0, worst_condition);
  return {unit_error * track.pair.Lambda.norm() * condition, part.size() > 1 ? part[1].norm() : 1.0};
}

ComplexMatrix centred(ComplexMatrix N) {
  N.diagonal().array() -= N.trace() / static_cast<double>(N.rows());
  return N;
}

ComplexMatrix centred(const std::vector<ComplexMatrix>& Lambda, double h) {
  return centred(evaluate_series(Lambda, h));
}

double RootResolution::of_root_with(double slope) const {
  return error_factor * lambda * distance / slope;
}

RootResolution resolution_of_roots(const Track& track, const std::vector<int>& members,
                                   const std::vector<ComplexMatrix>& part, const ComplexVector& discriminant,
                                   double reach) {
  // Norm of the centred part, relative to the block or to a thousandth of its change within reach, above
  // which the part is defective at a double root; below it the double eigenvalue is semisimple.
  constexpr double scalar = 1e-6;
  constexpr double share_of_change = 1e-3;
  // Rounding of the coordinate itself, relative to the reach. It matters where the eigenvalues are zero,
  // which have no rounding error of their own.
  constexpr double coordinate_rounding = 1e-14;
  // At a zero eigenvalue the stiffness cancels, so that its rounding is not known from the pencil.
  constexpr double zero = 1e-3;  // of the norm of the block, which is at least the reference
  PartRounding rounding = rounding_of(track, part);
  rounding.lambda = std::max(rounding.lambda, observed_error(track, discriminant));
  const double size = track.pair.Lambda.norm();
  const double slope = std::abs(discriminant[1]);
  const double curvature = std::abs(discriminant[2]);
  RootResolution known;
  known.lambda = rounding.lambda;
  known.distance = centred(part, 0.0).norm();
  known.defective =
      known.distance > scalar * std::max(size, share_of_change * rounding.slope * std::abs(reach));
  if (slope > 0.0)
    known.noise =
        resolution_rounding_margin * rounding.lambda * std::max(known.distance, rounding.lambda) / slope;
  // A single root, whose parabola has no other root within reach, moves by the error of the discriminant over
  // the slope; a double root by the square root of the error over the curvature.
  const bool is_single = slope > 2.0 * std::abs(reach) * curvature;
  known.roots = coordinate_rounding * std::abs(reach);
  if (known.defective && is_single) {
    known.roots = std::max(known.roots, known.of_root_with(slope));
  } else if (known.defective && curvature > 0.0) {
    known.roots = std::max(known.roots, std::sqrt(known.of_root_with(curvature)));
  } else {
    known.roots = std::max(known.roots, error_of_crossing(part, rounding.lambda, curvature));
  }
  Complex mean = 0.0;
  for (const int i : members) mean += track.roots[i] / static_cast<double>(members.size());
  known.bounded = known.defective && std::abs(mean) > zero * size;
  return known;
}

}  // namespace eigentrail
