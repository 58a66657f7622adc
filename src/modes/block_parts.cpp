#include "eigentrail/modes/block_parts.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "eigentrail/modes/invariants.hpp"

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

/// Eigenvalues with a smaller relative distance cannot be separated.
constexpr double same = 1e-13;

/// Solves D Y - Y A = R for upper triangular D and A.
ComplexMatrix solve_sylvester(const ComplexMatrix& D, const ComplexMatrix& A, const ComplexMatrix& R) {
  ComplexMatrix Y = R;
  for (Eigen::Index j = 0; j < A.rows(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) Y.col(j) += Y.col(i) * A(i, j);
    ComplexMatrix shifted = D;
    shifted.diagonal().array() -= A(j, j);
    Y.col(j) = shifted.triangularView<Eigen::Upper>().solve(Y.col(j)).eval();
  }
  return Y;
}

/// Smallest distance of the first m eigenvalues of a triangular T from the others.
double separation(const ComplexMatrix& T, Eigen::Index m) {
  double least = INFINITY;
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = m; j < T.rows(); ++j) least = std::min(least, std::abs(T(i, i) - T(j, j)));
  }
  return least;
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

std::vector<ComplexMatrix> part_series(const std::vector<ComplexMatrix>& Lambda,
                                       const std::vector<Complex>& part) {
  const Eigen::Index k = Lambda[0].rows();
  const auto m = static_cast<Eigen::Index>(part.size());
  if (m == k) return Lambda;
  const Eigen::Index r = k - m;
  const OrderedSchur schur = ordered_schur(Lambda[0], part);
  if (!(separation(schur.T, m) > same * schur.T.norm())) return {};
  const std::size_t count = Lambda.size();
  std::vector<ComplexMatrix> N{schur.T};
  for (std::size_t j = 1; j < count; ++j) N.emplace_back(schur.U.adjoint() * Lambda[j] * schur.U);
  const auto A = [&](std::size_t j) { return N[j].topLeftCorner(m, m); };
  const auto B = [&](std::size_t j) { return N[j].topRightCorner(m, r); };
  const auto C = [&](std::size_t j) { return N[j].bottomLeftCorner(r, m); };
  const auto D = [&](std::size_t j) { return N[j].bottomRightCorner(r, r); };
  std::vector<ComplexMatrix> Y{ComplexMatrix::Zero(r, m)};
  std::vector<ComplexMatrix> result{A(0)};  // coefficients of A + B Y
  for (std::size_t j = 1; j < count; ++j) {
    ComplexMatrix known = C(j);
    // D Y - Y (A + B Y) at order j, without its terms in Y_j.
    for (std::size_t i = 1; i < j; ++i) known += D(j - i) * Y[i] - Y[i] * result[j - i];
    Y.push_back(solve_sylvester(D(0), A(0), -known));
    ComplexMatrix sum = A(j);
    for (std::size_t i = 1; i <= j; ++i) sum += B(j - i) * Y[i];
    result.push_back(std::move(sum));
  }
  return result;
}

ComplexVector mean_series(const std::vector<ComplexMatrix>& Lambda) {
  ComplexVector mean(static_cast<Eigen::Index>(Lambda.size()));
  for (std::size_t j = 0; j < Lambda.size(); ++j)
    mean[static_cast<Eigen::Index>(j)] = Lambda[j].trace() / static_cast<double>(Lambda[j].rows());
  return mean;
}

ComplexVector product_series(const std::vector<ComplexMatrix>& Lambda) {
  ComplexVector product = ComplexVector::Zero(static_cast<Eigen::Index>(Lambda.size()));
  for (std::size_t i = 0; i < Lambda.size(); ++i) {
    for (std::size_t j = 0; i + j < Lambda.size(); ++j) {
      product[static_cast<Eigen::Index>(i + j)] +=
          Lambda[i](0, 0) * Lambda[j](1, 1) - Lambda[i](0, 1) * Lambda[j](1, 0);
    }
  }
  return product;
}

ComplexVector discriminant_series(const std::vector<ComplexMatrix>& Lambda, Eigen::Index count) {
  const auto size = static_cast<double>(Lambda[0].rows());
  const auto a = static_cast<double>(count);
  const double weight = size / (4.0 * a * (size - a));
  std::vector<ComplexMatrix> N = Lambda;
  // Subtracts the mean of the eigenvalues; the weighted trace of the square is then ((s_a - s_b) / 2)^2.
  for (ComplexMatrix& n : N) n.diagonal().array() -= n.trace() / size;
  ComplexVector discriminant = ComplexVector::Zero(static_cast<Eigen::Index>(N.size()));
  for (std::size_t i = 0; i < N.size(); ++i) {
    for (std::size_t j = 0; i + j < N.size(); ++j)
      discriminant[static_cast<Eigen::Index>(i + j)] += weight * N[i].cwiseProduct(N[j].transpose()).sum();
  }
  return discriminant;
}

ComplexVector discriminant_series(const ComplexVector& a, const ComplexVector& b) {
  const ComplexVector half = 0.5 * (a - b);
  return multiply_series(half, half);
}

ComplexVector root_series(const ComplexMatrix& functions, Complex root) {
  const Eigen::Index k = block_size(functions.rows());
  if (k == 1) return functions.row(0).transpose();
  if (k == 2) {
    if (functions.row(1).isZero(0.0)) return functions.row(0).transpose();  // both are one
    // The coefficients of sqrt(delta) follow from x^2 = delta. x_0 comes from the root, which is more
    // accurate than delta if the eigenvalues are nearly equal.
    ComplexVector x = ComplexVector::Zero(functions.cols());
    x[0] = root - functions(0, 0);
    if (std::abs(x[0]) <= same * std::abs(root)) return {};
    for (Eigen::Index j = 1; j < x.size(); ++j) {
      Complex square = functions(1, j);
      for (Eigen::Index i = 1; i < j; ++i) square -= x[i] * x[j - i];
      x[j] = square / (2.0 * x[0]);
    }
    x += functions.row(0).transpose();
    return x;
  }
  std::vector<ComplexMatrix> Lambda;
  for (Eigen::Index j = 0; j < functions.cols(); ++j) Lambda.emplace_back(functions.col(j).reshaped(k, k));
  const std::vector<ComplexMatrix> part = part_series(Lambda, {root});
  return part.empty() ? ComplexVector() : mean_series(part);
}

}  // namespace eigentrail
