// How far an eigenvalue of a projected family is from one of the large family.
#pragma once

#include <vector>

#include "projection/nearest_modes.hpp"

namespace eigentrail {

/// The matrices of a projected model at a place, k x k.
struct SmallPencil {
  Matrix M, C, K;
};

/// An eigenvalue of the projected pencil with unit vectors: (M s^2 + C s + K) right = 0, left^T (M s^2 + C s
/// + K) = 0 on the space. They have k entries, or n in the coordinates of the large pencil.
struct ProjectedMode {
  Complex s;
  ComplexVector right, left;
};

/// The mode of an eigenvalue s of the small pencil, by inverse iteration.
ProjectedMode mode_of(const SmallPencil& small, Complex s);

struct RefinedMode {
  ProjectedMode mode;
  bool is_settled = false;  ///< the eigenvalue is known to about 1e-16; not so where two of them meet
};

/// The mode of an eigenvalue that is known to few digits, corrected by inverse iteration and two-sided
/// Rayleigh quotients. Where these lead elsewhere s and the shape stay as they are; where s is not finite or
/// zero there are no vectors.
RefinedMode refined_mode(const SmallPencil& small, Complex s, const ComplexVector& shape);

/// The modes with vectors in the coordinates of the large pencil, for orthonormal bases of right and of left
/// ones, n x k.
std::vector<ProjectedMode> lifted(const std::vector<ProjectedMode>& modes, const Matrix& right_basis,
                                  const Matrix& left_basis);

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

/// An indicator of |s - s_large| for each of the modes, with vectors of n entries: the root of |P(s) z| |y^T
/// P(s)| = |y^T P'(s) z| d + |y^T P'' z| d^2 / 2 with both residuals measured by the diagonal of the pencil's
/// terms. It is of the order of the error in its dependence on the vectors; its factor is found where exact
/// eigenvalues are known.
std::vector<EigenvalueError> eigenvalue_errors(const SparsePencil& pencil,
                                               const std::vector<ProjectedMode>& modes);

/// The half gap of an eigenvalue of the small pencil.
double half_gap(const SmallPencil& small, const ProjectedMode& mode);

}  // namespace eigentrail
