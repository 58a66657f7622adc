// The space onto which a large family is projected: an orthonormal basis of the vectors of its modes.
#pragma once

#include <utility>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Which vectors of a pencil are meant. With `both`, right ones that span the same space as left ones.
enum class Side { right, left, both };

class ProjectionSpace {
 public:
  explicit ProjectionSpace(Eigen::Index n) : basis_(n, 0), vectors_(0, 0) {}

  const Matrix& basis() const { return basis_; }  ///< n x k, orthonormal

  /// Gives the basis away, and takes it back before more vectors are added: a projected model has it
  /// meanwhile.
  Matrix give_basis() { return std::move(basis_); }
  void take_basis(Matrix basis) { basis_ = std::move(basis); }

  /// Adds the real and imaginary parts of unit vectors (columns), as far as they are not in the space.
  void add(const ComplexMatrix& vectors, Side side);

  /// Keeps the part of the space that the vectors need up to a relative error `accuracy` in the norm of the
  /// symmetric positive semidefinite `energy` (k x k, in this basis): their principal components in this
  /// norm. What is left out is forgotten.
  void reduce(const Matrix& energy, double accuracy);

  /// Principal components of vectors in the norm of an energy.
  struct Components {
    Matrix parts;   ///< k x k, in this basis, by descending size
    Vector values;  ///< of the first ones: what each contributes to unit vectors

    /// How many the vectors need up to a relative error `accuracy`.
    Eigen::Index needed(double accuracy) const { return (values.array() > accuracy).count(); }
  };

  /// Those of all vectors (`both`), or of those of one side. `energy` as in `reduce`.
  Components components(const Matrix& energy, Side side) const;

 private:
  Matrix basis_;
  Matrix vectors_;           ///< k x N: the vectors that were added, in this basis
  std::vector<Side> sides_;  ///< N
};

// A smaller projection of a pencil P that is not symmetric: on a space V of its right vectors and a space W
// of its left ones (Petrov-Galerkin), W^T P V, in place of Q^T P Q with the sum of both as Q. The error of an
// eigenvalue is that of its right vector in V times that of its left one in W.
//
// W^T P V is as far from singular as the angles between the spaces are from right angles. In the norm of an
// energy E, let v_i and w_i be their principal vectors (Bjorck and Golub, Numerical methods for computing
// angles between linear subspaces, 1973), with v_i^T E w_j = cos(a_i) for i = j, else 0. Where cos(a_i) is
// small each space gets the vector of the other one: there the projection is one onto the sum of both.

/// Orthonormal bases in the basis of a space that has both, k x r.
struct TwoSpaces {
  Matrix right, left;
};

/// Spaces that the right and the left vectors of `both` need up to a relative error `accuracy` in the norm of
/// the symmetric part of `energy` (k x k), equally large.
TwoSpaces two_spaces(const ProjectionSpace& both, const Matrix& energy, double accuracy);

}  // namespace eigentrail
