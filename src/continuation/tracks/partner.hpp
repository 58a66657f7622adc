// Candidates for a block with a given track, and where eigenvalues meet.
//
// The radius of convergence of the series of two eigenvalues is limited by the exceptional point where they
// coincide, a root of ((s_i - s_j)/2)^2 in the complex plane of the path's coordinate. That function is
// smooth there, so that the root follows from its own series.
//
// Estimated errors of the dense output on the step from `left` to `right`, of signed length h, if its modes
// were grouped in another way. The decisions to join modes and to separate blocks use them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Largest number of eigenvalues of a block that is formed on the way. Bounds its cost: a block of k
/// eigenvalues takes k factorizations, and its dense output has k^2 functions.
inline constexpr Eigen::Index largest_block = 16;

/// A candidate for a block with a given track: another track, or the track's own conjugate.
struct Partner {
  bool conjugate = false;  ///< the own conjugate; `track` is then the track itself
  std::size_t track = 0;   ///< index of the other track
  double distance = 0.0;   ///< of their nearest meeting from the step, in the coordinate along the path
};

/// The partners whose nearest meeting with `track` is at most `reach` |h| away from the step [0, h], by
/// ascending distance.
std::vector<Partner> find_partners(const PathNode& node, std::size_t track, double h, double reach);

/// Whether a partner may be the reason why the series of `track` converges no farther: its own is as
/// singular.
bool may_limit(const PathNode& node, std::size_t track, const Partner& partner);

/// Those of find_partners that may be the reason why the series of `track` converges no farther.
std::vector<Partner> limiting_partners(const PathNode& node, std::size_t track, double h, double reach);

/// The track with the eigenvalue nearest to one of `track`, or its own conjugate; the distance is that of the
/// eigenvalues. Empty if there is none in its chart.
std::optional<Partner> nearest_partner(const PathNode& node, std::size_t track);

/// Whether meetings at places where the series are not accurate count.
enum class Doubtful { counts, is_left_out };

/// Distance from the step [0, h] of the nearest meeting of two eigenvalues with these series; infinite beyond
/// `limit`. For blocks, the series are those of the means, and `spread` is the square of the radius of the
/// eigenvalues about the mean: the magnitude of the discriminant is reduced by it, to allow for the members
/// that are closest to each other. Where their discs overlap, means tell nothing: infinite.
double meeting_distance(const ComplexVector& a, const ComplexVector& b, double spread, double h, double limit,
                        Doubtful doubtful);

/// Number of eigenvalues of a track; one where all are the same to the root of rounding, as those of equal
/// parts.
Eigen::Index distinct_eigenvalues(const Track& track);

/// Absolute error of the eigenvalues of a track and its partners as one block. `least_gap`: distances of
/// eigenvalues count as no less. Infinite if their series are not known.
double error_as_block(const PathNode& left, const PathNode& right, std::size_t track,
                      const std::vector<Partner>& partners, double h, double least_gap);

/// Error of a single mode in the other chart, relative to max(|mu|, reference). Infinite for a block.
double error_in_other_chart(const PathProblem& problem, const PathNode& left, const PathNode& right,
                            std::size_t track, double h);

/// Error of every eigenvalue of a block as a single mode, in the chart in which it is smaller, relative to
/// max(|mu|, reference). Infinite where it is not known.
Vector errors_as_singles(const PathProblem& problem, const PathNode& left, const PathNode& right,
                         std::size_t track, double h);

}  // namespace eigentrail
