// How far an eigenvalue of a projected family is from one of the large family.
#pragma once

#include "eigentrail/continuation/trace_result.hpp"
#include "projection/nearest_modes.hpp"

namespace eigentrail {

/// An eigenvalue of the projected pencil with its vectors in the coordinates of the large pencil.
struct ProjectedMode {
  Complex s;
  ComplexVector right;  ///< n, unit length
  ComplexVector left;   ///< n, unit length: y^T P(s) = 0 on the space
};

/// Left vector of the eigenvalue s of the small pencil (M s^2 + C s + K): unit length, y^T P(s) = 0. Two
/// steps of inverse iteration.
ComplexVector left_vector(const Matrix& M, const Matrix& C, const Matrix& K, Complex s);

/// Corrects the eigenvalue and the shape of a mode of the small pencil, which a rough trace knows to few
/// digits, by inverse iteration and two-sided Rayleigh quotients. Leaves it where these lead elsewhere.
void refine(const Matrix& M, const Matrix& C, const Matrix& K, ModeState& mode);

/// How far an eigenvalue may be from one of the large pencil.
struct EigenvalueError {
  double distance = 0.0;  ///< 1/s
  /// About half the distance to the eigenvalue that it meets where right and left vector become orthogonal,
  /// 1/s: |y^T P' z| / |y^T P'' z|. The conjugate, if no other is nearer.
  double half_gap = 0.0;

  /// The error as the tolerance counts it, relative to `size` = max(|s|, reference): where two eigenvalues
  /// meet they move by the root of what the pencil changes, and the square of their distance counts.
  double relative_to(double size) const;
};

/// An indicator of |s - s_large|, the root of |P(s) z| |y^T P(s)| = |y^T P'(s) z| d + |y^T P'' z| d^2 / 2
/// with both residuals measured by the diagonal of the pencil's terms. It is of the order of the error in its
/// dependence on the vectors; its factor is found where exact eigenvalues are known.
EigenvalueError eigenvalue_error(const SparsePencil& pencil, const ProjectedMode& mode);

/// The half gap of an eigenvalue of the small pencil, whose right vector is known.
double half_gap(const Matrix& M, const Matrix& C, const Matrix& K, const ModeState& mode);

}  // namespace eigentrail
