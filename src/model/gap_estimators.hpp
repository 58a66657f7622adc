// How much the interpolant of samples misses between two of them: combinations of the samples that estimate
// it.
#pragma once

#include <array>
#include <vector>

#include "eigentrail/core/types.hpp"
#include "eigentrail/model/sample_errors.hpp"

namespace eigentrail {

struct SamplePiece;

/// The samples of a piece that an estimate for a gap looks at.
struct GapWindow {
  std::size_t first = 0;      ///< index of the first sample
  std::vector<double> nodes;  ///< their values
  std::size_t gap = 0;        ///< the gap, counted in the window
  Eigen::Index offset = 0;    ///< of the window in the piece
};

/// `gap`: index of the sample before it.
GapWindow window_at(const SamplePiece& piece, std::size_t gap);

/// What the interpolants of neighbouring degrees differ by at places of a gap, and what the leave-one-out
/// interpolants miss at its ends: combinations of the samples of the window, one per column.
struct GapEstimators {
  std::array<Matrix, 3> differences;        ///< of the highest pair of degrees, the next, the next
  Matrix leave_one_out;                     ///< what is missed at the ends of the gap
  Matrix nearby;                            ///< and at the samples near it
  std::array<double, 3> share = {1, 0, 0};  ///< factor of each difference
  Matrix rival;  ///< what the interpolant of the modest degree differs by, extrapolated
  /// What the lines through the two samples before the gap and behind it differ by: of a function with a kink
  /// in the gap, the smaller difference is true (subcell resolution: Harten, J. Comput. Phys. 83, 1989).
  Matrix before, behind;
  double amplification = 1.0;  ///< of errors of the samples that are not smooth
  Vector weights;              ///< largest magnitude of each basis function
};

GapEstimators gap_estimators(const SamplePiece& piece, const GapWindow& window,
                             const SampleErrorOptions& options);

}  // namespace eigentrail
