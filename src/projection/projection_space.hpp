// The space onto which a large family is projected: an orthonormal basis of the vectors of its modes.
#pragma once

#include <utility>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class ProjectionSpace {
 public:
  explicit ProjectionSpace(Eigen::Index n) : basis_(n, 0), vectors_(0, 0) {}

  const Matrix& basis() const { return basis_; }  ///< n x k, orthonormal

  /// Gives the basis away, and takes it back before more vectors are added: a projected model has it
  /// meanwhile.
  Matrix give_basis() { return std::move(basis_); }
  void take_basis(Matrix basis) { basis_ = std::move(basis); }

  /// Adds the real and imaginary parts of unit vectors (columns), as far as they are not in the space.
  void add(const ComplexMatrix& vectors);

  /// Keeps the part of the space that the vectors need up to a relative error `accuracy` in the norm of the
  /// symmetric positive semidefinite `energy` (k x k, in this basis): their principal components in this
  /// norm. What is left out is forgotten.
  void reduce(const Matrix& energy, double accuracy);

 private:
  /// Basis of that part, k x r with orthonormal columns.
  Matrix principal(const Matrix& energy, double accuracy) const;

  Matrix basis_;
  Matrix vectors_;  ///< k x N: the vectors that were added, in this basis
};

}  // namespace eigentrail
