#include "modes/real_blocks.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/matrix_series.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// Limit of the largest squared singular value that a real basis leaves out, over the smallest that it keeps.
constexpr double largest_remainder = 1e-2;
/// Limit of the sum of the eigenvalues of a block with both roots, over the largest eigenvalue: s and -s
/// cancel.
constexpr double largest_sum = 1e-2;

/// Series S(h) with S^2 = A, where A[0] is diagonal and positive. The equations S_0 X + X S_0 = known are
/// solved by division by sums of roots.
std::vector<Matrix> square_root(const std::vector<Matrix>& A) {
  const Vector root = A[0].diagonal().cwiseSqrt();
  const Eigen::Index k = root.size();
  const Matrix sums = root.replicate(1, k) + root.transpose().replicate(k, 1);
  std::vector<Matrix> S{root.asDiagonal()};
  for (std::size_t j = 1; j < A.size(); ++j) {
    Matrix rest = A[j];
    for (std::size_t i = 1; i < j; ++i) rest -= S[i] * S[j - i];
    S.emplace_back(rest.cwiseQuotient(sums));
  }
  return S;
}

/// Direction of the root in the complex plane: root = direction * sqrt(|lambda|).
Complex direction(Root root) {
  if (root == Root::imaginary) return {0.0, 1.0};
  return root == Root::positive ? 1.0 : -1.0;
}

/// The pair of a block in the basis of its modes, not normalized.
PairSeries modal_pair(Root root, const RealSeries& modes) {
  PairSeries pair;
  const Eigen::Index n = modes.X[0].rows();
  const Eigen::Index k = modes.X[0].cols();
  if (root != Root::both) {
    const double sign = root == Root::imaginary ? -1.0 : 1.0;
    std::vector<Matrix> squares;
    for (const Matrix& L : modes.L) squares.emplace_back(sign * L);
    for (const Matrix& X : modes.X) pair.Z.emplace_back(X.cast<Complex>());
    for (const Matrix& S : square_root(squares)) pair.Lambda.emplace_back(direction(root) * S);
    return pair;
  }
  for (std::size_t j = 0; j < modes.X.size(); ++j) {
    ComplexMatrix Z = ComplexMatrix::Zero(n, 2 * k);
    ComplexMatrix Lambda = ComplexMatrix::Zero(2 * k, 2 * k);
    Z.leftCols(k) = modes.X[j].cast<Complex>();
    Lambda.bottomLeftCorner(k, k) = modes.L[j].cast<Complex>();
    if (j == 0) Lambda.topRightCorner(k, k).setIdentity();
    pair.Z.push_back(std::move(Z));
    pair.Lambda.push_back(std::move(Lambda));
  }
  return pair;
}

/// W0^H Z + W1^H Z Lambda; a pair is normalized by its inverse.
std::vector<ComplexMatrix> normalization(const PairSeries& pair, const ComplexMatrix& W) {
  const Eigen::Index n = pair.Z[0].rows();
  const ComplexMatrix W0 = W.topRows(n).adjoint();
  const ComplexMatrix W1 = W.bottomRows(n).adjoint();
  std::vector<ComplexMatrix> of_Z, of_slope;
  for (const ComplexMatrix& Z : pair.Z) {
    of_Z.emplace_back(W0 * Z);
    of_slope.emplace_back(W1 * Z);
  }
  std::vector<ComplexMatrix> sum = multiply_series(of_slope, pair.Lambda, pair.Z.size());
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += of_Z[j];
  return sum;
}

/// The same for one mode with one root. Here W1 = 0, and Lambda does not depend on the length of the vector.
PairSeries single_series(Root root, const RealSeries& mode, const ComplexMatrix& W) {
  const std::size_t count = mode.X.size();
  const double sign = root == Root::imaginary ? -1.0 : 1.0;
  const ComplexVector w = W.col(0).head(mode.X[0].rows());
  std::vector<double> s{std::sqrt(sign * mode.L[0](0, 0))};
  std::vector<Complex> length;
  PairSeries pair;
  for (std::size_t j = 0; j < count; ++j) {
    length.push_back(w.dot(mode.X[j].col(0)));
    ComplexVector z = mode.X[j].cast<Complex>();
    for (std::size_t i = 1; i <= j; ++i) z -= length[i] * pair.Z[j - i].col(0);
    pair.Z.emplace_back(z / length[0]);
    double rest = sign * mode.L[j](0, 0);
    for (std::size_t i = 1; i < j; ++i) rest -= s[i] * s[j - i];
    if (j > 0) s.push_back(0.5 * rest / s[0]);
    pair.Lambda.emplace_back(ComplexMatrix::Constant(1, 1, direction(root) * s[j]));
  }
  return pair;
}

}  // namespace

std::optional<Root> root_of(const InvariantPair& start) {
  if (start.chart != Chart::finite || !start.Lambda.allFinite()) return std::nullopt;
  const ComplexVector s = pair_eigenvalues(start);
  if (!start.is_real) return (s.imag().array() > 0.0).all() ? std::optional(Root::imaginary) : std::nullopt;
  const double size = s.cwiseAbs().maxCoeff();
  if (s.size() % 2 == 0 && std::abs(s.sum()) <= largest_sum * size) return Root::both;
  if (!s.imag().isZero(0.0)) return std::nullopt;
  if ((s.real().array() > 0.0).all()) return Root::positive;
  return (s.real().array() < 0.0).all() ? std::optional(Root::negative) : std::nullopt;
}

std::optional<Matrix> real_basis(const ComplexMatrix& Z, Eigen::Index k) {
  Matrix parts(Z.rows(), 2 * Z.cols());
  parts << Z.real(), Z.imag();
  if (k > Z.rows() || !parts.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix> directions(Matrix(parts.transpose() * parts));
  const Vector& squares = directions.eigenvalues();  // in increasing order
  const Eigen::Index left_out = squares.size() - k;
  const double least = squares[left_out];
  if (!(least > 0.0) || squares[left_out - 1] > largest_remainder * least) return std::nullopt;
  return parts * directions.eigenvectors().rightCols(k) *
         squares.tail(k).cwiseSqrt().cwiseInverse().asDiagonal();
}

PairSeries pair_series(Root root, const RealSeries& modes, const ComplexMatrix& W) {
  if (W.cols() == 1) return single_series(root, modes, W);
  const PairSeries pair = modal_pair(root, modes);
  const std::size_t count = pair.Z.size();
  const std::vector<ComplexMatrix> size = normalization(pair, W);
  const std::vector<ComplexMatrix> T = inverse_series(size);
  return {multiply_series(pair.Z, T, count),
          multiply_series(size, multiply_series(pair.Lambda, T, count), count)};
}

PairSensitivity sensitivity(Root root, const Matrix& X, const Vector& lambda, const ComplexMatrix& W,
                            const Vector& terms) {
  const auto of_rows = [&](const ComplexMatrix& rows) {
    return PairSensitivity{rows.norm(), (rows.cwiseAbs() * terms).norm()};
  };
  if (W.cols() == 1) {
    const Complex length = W.col(0).head(X.rows()).dot(X.col(0));
    return of_rows(0.5 * length / std::sqrt(std::abs(lambda[0])) * X.transpose());
  }
  const PairSeries pair = modal_pair(root, {{X}, {Matrix(lambda.asDiagonal())}});
  const ComplexMatrix size = normalization(pair, W)[0];
  // Modal coordinates of [0; M^-1 R]: X^T R for a mode with both roots (the velocity part), X^T R / (2 s) for
  // a single root.
  if (root == Root::both) return of_rows(size.rightCols(X.cols()) * X.transpose());
  const Vector share = 0.5 * (lambda).cwiseAbs().cwiseSqrt().cwiseInverse();
  return of_rows(size * share.asDiagonal() * X.transpose());
}

}  // namespace eigentrail
