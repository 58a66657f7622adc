#include "projection/two_spaces.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "core/orthonormal.hpp"
#include "core/products.hpp"
#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// Least cosine of the angle between principal vectors of both spaces. With 0.02, eigenvalues of the
/// projection that stand for none of the large pencil come near to the followed ones; with 0.3 it has a tenth
/// more coordinates.
constexpr double least_cosine = 0.1;

/// Vectors with x_i^T E x_j = 0 for i != j, else +-1, in the space of the columns of B.
Matrix normalized(const Matrix& B, const Matrix& energy) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(congruence(B, energy, B));
  const Vector sizes = solver.eigenvalues().cwiseAbs();
  const double floor = std::numeric_limits<double>::epsilon() * sizes.maxCoeff();
  return product(
      B, Matrix(solver.eigenvectors() * sizes.cwiseMax(floor).cwiseSqrt().cwiseInverse().asDiagonal()));
}

Matrix joined(const Matrix& A, const Matrix& B) {
  Matrix both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}

}  // namespace

TwoSpaces two_spaces(const ProjectionSpace& both, const Matrix& energy, double accuracy) {
  const Matrix E = 0.5 * (energy + energy.transpose());
  const auto of_right = both.components(E, Side::right), of_left = both.components(E, Side::left);
  const Eigen::Index count = std::max(of_right.needed(accuracy), of_left.needed(accuracy));
  Matrix V = normalized(of_right.parts.leftCols(count), E), W = normalized(of_left.parts.leftCols(count), E);
  const SingularVectors<Matrix> angles = singular_vectors(congruence(W, E, V));
  const Eigen::Index few = (angles.values.array() < least_cosine).count();
  const Matrix v = product(V, Matrix(angles.V.rightCols(few)));
  const Matrix w = product(W, Matrix(angles.U.rightCols(few)));
  V = orthonormal(joined(V, w));
  W = orthonormal(joined(W, v));
  // The polar factor of W^T E V turns the left basis to the right one.
  const SingularVectors<Matrix> turn = singular_vectors(congruence(W, E, V));
  return {std::move(V), product(W, product(turn.U, Matrix(turn.V.transpose())))};
}

}  // namespace eigentrail
