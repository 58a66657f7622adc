#include "modes/ordered_schur.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace eigentrail {
namespace {

/// Swaps the diagonal entries i and i + 1 of the triangular T by a unitary (Givens) rotation.
void swap_neighbours(ComplexMatrix& T, ComplexMatrix& U, Eigen::Index i) {
  Eigen::JacobiRotation<Complex> rotation;
  rotation.makeGivens(T(i, i + 1), T(i + 1, i + 1) - T(i, i));
  T.applyOnTheLeft(i, i + 1, rotation.adjoint());
  T.applyOnTheRight(i, i + 1, rotation);
  U.applyOnTheRight(i, i + 1, rotation);
  T(i + 1, i) = 0.0;
}

}  // namespace

OrderedSchur ordered_schur(const ComplexMatrix& Lambda, const std::vector<Complex>& leading) {
  const Eigen::ComplexSchur<ComplexMatrix> schur(Lambda);
  OrderedSchur result{schur.matrixT().triangularView<Eigen::Upper>(), schur.matrixU()};
  for (std::size_t target = 0; target < leading.size(); ++target) {
    Eigen::Index nearest = static_cast<Eigen::Index>(target);
    for (Eigen::Index i = nearest + 1; i < Lambda.rows(); ++i) {
      if (std::abs(result.T(i, i) - leading[target]) < std::abs(result.T(nearest, nearest) - leading[target]))
        nearest = i;
    }
    for (Eigen::Index i = nearest; i > static_cast<Eigen::Index>(target); --i)
      swap_neighbours(result.T, result.U, i - 1);
  }
  return result;
}

}  // namespace eigentrail
