// The linearized equations of an invariant pair: one bordered system per column of its Schur form.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "eigentrail/modes/invariant_pair.hpp"
#include "modes/bordered_band.hpp"

namespace eigentrail {

namespace {

/// Relative imaginary parts below this are neglected in the real factors. The error then decreases by about
/// this factor per correction.
constexpr double unreal = 1e-6;

/// Phase of a vector that is real up to a phase; empty if it is not.
std::optional<Complex> phase_of(const ComplexVector& z) {
  const Complex square = (z.transpose() * z)(0, 0);
  if (!(std::abs(square) > 0.0)) return std::nullopt;
  const Complex phase = std::sqrt(square / std::abs(square));
  const bool is_real = (std::conj(phase) * z).imag().norm() <= unreal * z.norm();
  return is_real ? std::optional(phase) : std::nullopt;
}

/// Direction of s for which P(s) is real: 1 if s is real, i if s is imaginary and there is no damping; else
/// empty.
std::optional<Complex> direction_of(const PencilAtPoint& pencil, Complex s) {
  if (std::abs(s.imag()) <= unreal * unreal * std::abs(s.real())) return 1.0;
  const bool imaginary = std::abs(s.real()) <= unreal * unreal * std::abs(s.imag());
  return pencil.is_undamped() && imaginary ? std::optional(Complex(0.0, 1.0)) : std::nullopt;
}

/// [P, X; Y, D], restricted to the vectors of a complex part.
ComplexMatrix bordered_matrix(const PencilAtPoint& pencil, Complex mu, const ComplexMatrix& X,
                              const ComplexMatrix& Y, const ComplexMatrix& D) {
  const int complex_sign = pencil.complex_sign;
  const Eigen::Index n = complex_sign == 0 ? pencil.size() : pencil.size() / 2, k = D.rows();
  ComplexMatrix B(n + k, n + k);
  B.bottomRightCorner(k, k) = D;
  if (complex_sign == 0) {
    B.topLeftCorner(n, n) = pencil.matrix(mu);
    B.topRightCorner(n, k) = X;
    B.bottomLeftCorner(k, n) = Y;
    return B;
  }
  B.topLeftCorner(n, n) = complex_block(pencil.matrix(mu), complex_sign);
  B.topRightCorner(n, k) = complex_coordinates(X, complex_sign);
  B.bottomLeftCorner(k, n) = complex_coordinates(Y.adjoint(), complex_sign).adjoint();
  return B;
}

}  // namespace

BorderedLu::BorderedLu(const PencilAtPoint& pencil, Complex mu, const ComplexMatrix& Z,
                       const ComplexMatrix& X, const ComplexMatrix& Y, const ComplexMatrix& D)
    : n_(pencil.size()), k_(D.rows()), complex_sign_(pencil.complex_sign) {
  if (pencil.bands && complex_sign_ == 0) {
    auto factors = std::make_shared<const BorderedBand>(pencil.bands.sum(mu * mu, mu, 1.0), Z, X, Y, D);
    if (factors->is_accurate()) banded_ = std::move(factors);
  }
  if (!banded_) lu_.emplace(bordered_matrix(pencil, mu, X, Y, D));
}

template <class Solve>
void BorderedLu::solve(Eigen::Ref<ComplexMatrix> B, const Solve& by) const {
  if (banded_) return by(*banded_, B);
  if (complex_sign_ == 0) return by(*lu_, B);
  ComplexMatrix within = restricted(B);
  by(*lu_, within);
  B.topRows(n_) = from_complex_coordinates(within.topRows(n_ / 2), complex_sign_);
  B.bottomRows(k_) = within.bottomRows(k_);
}

void BorderedLu::solve_in_place(Eigen::Ref<ComplexMatrix> B) const {
  solve(B, [](const auto& factors, Eigen::Ref<ComplexMatrix> X) { factors.solve_in_place(X); });
}

void BorderedLu::solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const {
  solve(B, [](const auto& factors, Eigen::Ref<ComplexMatrix> X) { factors.solve_adjoint_in_place(X); });
}

ComplexMatrix BorderedLu::restricted(const ComplexMatrix& b) const {
  ComplexMatrix within(n_ / 2 + k_, b.cols());
  within << complex_coordinates(b.topRows(n_), complex_sign_), b.bottomRows(k_);
  return within;
}

PairFactorization::PairFactorization(const PencilAtPoint& pencil, const ComplexMatrix& Z,
                                     const ComplexMatrix& Lambda, const ComplexMatrix& W) {
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  ComplexMatrix T = Lambda;
  ComplexMatrix ZU = Z;
  ComplexMatrix WU = W;
  if (k > 1) {
    const Eigen::ComplexSchur<ComplexMatrix> schur(Lambda);
    T = schur.matrixT().triangularView<Eigen::Upper>();
    ZU = Z * schur.matrixU();
    WU = W * schur.matrixU();
    const auto full = [&](const Matrix& B) { return pencil.bands ? Matrix() : B; };
    coupling_ = {full(pencil.M),  full(pencil.C), pencil.bands, schur.matrixU(), T, T * T, ZU,
                 WU.bottomRows(n)};
  }
  const ComplexMatrix MZ = multiply(pencil.M, pencil.bands.M, ZU);
  const ComplexMatrix CZ = multiply(pencil.C, pencil.bands.C, ZU);
  const ComplexMatrix WZ = WU.bottomRows(n).adjoint() * ZU;
  // The border is scaled by the sum of the norms of the terms of P. For n = 1 the norm of P itself is zero at
  // an eigenvalue.
  const double terms = pencil.magnitude(T.diagonal().cwiseAbs().maxCoeff());
  // If all terms are zero (eigenvalue zero without stiffness), the norms of the matrices give the scale.
  const double whole = pencil.norm_M + pencil.norm_C + pencil.norm_K;
  const double size = std::max((terms > 0.0 ? terms : whole) / std::sqrt(static_cast<double>(n)), 1e-300);
  const double slope = (2.0 * MZ * T + CZ).norm();
  slope_scale_ = slope > 0.0 ? size / slope : size;
  border_scale_ = size;
  if (k == 1 && pencil.complex_sign == 0 && !pencil.bands &&
      factor_real(pencil, Z, T(0, 0), W.col(0).head(n), 2.0 * MZ * T + CZ))
    return;
  columns_.reserve(static_cast<std::size_t>(k));
  for (Eigen::Index j = 0; j < k; ++j) {
    const Complex t = T(j, j);
    columns_.emplace_back(pencil, t, ZU, slope_scale_ * (MZ * (T + t * ComplexMatrix::Identity(k, k)) + CZ),
                          border_scale_ * (WU.topRows(n).adjoint() + t * WU.bottomRows(n).adjoint()),
                          border_scale_ * slope_scale_ * WZ);
  }
}

bool PairFactorization::factor_real(const PencilAtPoint& pencil, const ComplexVector& z, Complex s,
                                    const ComplexVector& w, const ComplexVector& slope) {
  const std::optional<Complex> direction = direction_of(pencil, s);
  const std::optional<Complex> phase = direction ? phase_of(z) : std::nullopt;
  if (!phase || (std::conj(*phase) * w).imag().norm() > unreal * w.norm()) return false;
  const Eigen::Index n = z.size();
  Matrix B = Matrix::Zero(n + 1, n + 1);
  B.topLeftCorner(n, n) = (s * s).real() * pencil.M + pencil.K;
  if (!pencil.is_undamped()) B.topLeftCorner(n, n) += s.real() * pencil.C;
  B.topRightCorner(n, 1) = slope_scale_ * (std::conj(*phase * *direction) * slope).real();
  B.bottomLeftCorner(1, n) = border_scale_ * (std::conj(*phase) * w).real().transpose();
  real_.emplace(RealMode{RealLu(std::move(B)), *phase, *direction});
  return true;
}

void PairFactorization::solve(const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ,
                              ComplexMatrix& dLambda) const {
  ComplexVector b(R.size() + N.size());
  b << R.reshaped(), N.reshaped();
  solve_in_place(b);
  dZ = b.head(R.size()).reshaped(R.rows(), R.cols());
  dLambda = b.tail(N.size()).reshaped(N.rows(), N.cols());
}

void PairFactorization::solve_in_place(Eigen::Ref<ComplexMatrix> B) const {
  if (coupling_) return solve_block(B);
  auto vectors = B.topRows(B.rows() - 1);
  auto last = B.bottomRows(1);
  last *= border_scale_;
  if (real_) {
    vectors *= std::conj(real_->phase);
    real_->lu.solve_in_place(B);
    vectors *= real_->phase;
    last *= std::conj(real_->direction);
  } else {
    columns_.front().solve_in_place(B);
  }
  last *= slope_scale_;
}

void PairFactorization::solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const {
  if (coupling_) return solve_block_adjoint(B);
  auto vectors = B.topRows(B.rows() - 1);
  auto last = B.bottomRows(1);
  last *= slope_scale_;
  if (real_) {
    vectors *= std::conj(real_->phase);
    last *= real_->direction;
    real_->lu.solve_adjoint_in_place(B);
    vectors *= real_->phase;
  } else {
    columns_.front().solve_adjoint_in_place(B);
  }
  last *= border_scale_;
}

PairFactorization::InSchurForm PairFactorization::in_schur_form(
    const Eigen::Ref<const ComplexMatrix>& B) const {
  const ComplexMatrix& U = coupling_->U;
  const Eigen::Index n = coupling_->Z.rows();
  const Eigen::Index k = U.rows();
  const Eigen::Index m = B.cols();
  InSchurForm columns{ComplexMatrix::Zero(n, k * m), ComplexMatrix::Zero(k, k * m)};
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index i = 0; i < k; ++i) {
      columns.X.middleCols(j * m, m) += U(i, j) * B.middleRows(i * n, n);
      columns.Y.middleCols(j * m, m) += U(i, j) * B.middleRows(n * k + i * k, k);
    }
  }
  columns.Y = (U.adjoint() * columns.Y).eval();
  return columns;
}

void PairFactorization::from_schur_form(const InSchurForm& columns, Eigen::Ref<ComplexMatrix> B) const {
  const ComplexMatrix& U = coupling_->U;
  const Eigen::Index n = coupling_->Z.rows();
  const Eigen::Index k = U.rows();
  const Eigen::Index m = B.cols();
  const ComplexMatrix UY = U * columns.Y;
  B.setZero();
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index i = 0; i < k; ++i) {
      B.middleRows(i * n, n) += std::conj(U(i, j)) * columns.X.middleCols(j * m, m);
      B.middleRows(n * k + i * k, k) += std::conj(U(i, j)) * UY.middleCols(j * m, m);
    }
  }
}

void PairFactorization::solve_block(Eigen::Ref<ComplexMatrix> B) const {
  const auto& [M, C, bands, U, T, T2, Z, W1] = *coupling_;
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  const Eigen::Index m = B.cols();
  InSchurForm columns = in_schur_form(B);
  auto& [X, Y] = columns;  // right sides, then solutions
  ComplexMatrix column(n + k, m);
  for (Eigen::Index j = 0; j < k; ++j) {
    auto Xj = X.middleCols(j * m, m);
    auto Yj = Y.middleCols(j * m, m);
    if (j > 0) {
      // Contribution of the previous columns through the strict upper triangle of T.
      ComplexMatrix Xt = ComplexMatrix::Zero(n, m), Xt2 = Xt, Yt = ComplexMatrix::Zero(k, m);
      for (Eigen::Index i = 0; i < j; ++i) {
        Xt += T(i, j) * X.middleCols(i * m, m);
        Xt2 += T2(i, j) * X.middleCols(i * m, m);
        Yt += T(i, j) * Y.middleCols(i * m, m);
      }
      Xj -= multiply(M, bands.M, Xt2 + Z.lazyProduct(Yt)) + multiply(C, bands.C, Xt);
      Yj -= W1.adjoint() * Xt;
    }
    column << Xj, border_scale_ * Yj;
    columns_[static_cast<std::size_t>(j)].solve_in_place(column);
    Xj = column.topRows(n);
    Yj = slope_scale_ * column.bottomRows(k);
  }
  from_schur_form(columns, B);
}

void PairFactorization::solve_block_adjoint(Eigen::Ref<ComplexMatrix> B) const {
  const auto& [M, C, bands, U, T, T2, Z, W1] = *coupling_;
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  const Eigen::Index m = B.cols();
  InSchurForm columns = in_schur_form(B);
  auto& [X, Y] = columns;
  ComplexMatrix column(n + k, m);
  for (Eigen::Index j = k - 1; j >= 0; --j) {
    column << X.middleCols(j * m, m), slope_scale_ * Y.middleCols(j * m, m);
    columns_[static_cast<std::size_t>(j)].solve_adjoint_in_place(column);
    const ComplexMatrix Xj = column.topRows(n);
    const ComplexMatrix Yj = border_scale_ * column.bottomRows(k);
    X.middleCols(j * m, m) = Xj;
    Y.middleCols(j * m, m) = Yj;
    if (j == 0) break;
    const ComplexMatrix MX = transposed_multiply(M, bands.M, Xj);
    const ComplexMatrix Xt = transposed_multiply(C, bands.C, Xj) + W1.lazyProduct(Yj);
    const ComplexMatrix ZMX = Z.adjoint() * MX;
    for (Eigen::Index i = 0; i < j; ++i) {
      X.middleCols(i * m, m) -= std::conj(T2(i, j)) * MX + std::conj(T(i, j)) * Xt;
      Y.middleCols(i * m, m) -= std::conj(T(i, j)) * ZMX;
    }
  }
  from_schur_form(columns, B);
}

PairSensitivity PairFactorization::sensitivity(const Vector& terms) const {
  PairSensitivity squares;
  // `row` gives an entry of dLambda from R.
  const auto add = [&](const ComplexVector& row) {
    squares.to_residual += row.squaredNorm();
    squares.to_terms += std::pow(row.cwiseAbs().dot(terms), 2);
  };
  if (real_) {
    ComplexVector y = ComplexVector::Unit(real_->lu.size(), real_->lu.size() - 1);
    real_->lu.solve_adjoint_in_place(y);
    add(y.head(y.size() - 1));
  }
  const auto k = static_cast<Eigen::Index>(columns_.size());
  for (const BorderedLu& lu : columns_) {
    for (Eigen::Index i = 0; i < k; ++i) {
      ComplexVector y = ComplexVector::Unit(lu.size(), lu.size() - k + i);
      lu.solve_adjoint_in_place(y);
      add(y.head(lu.size() - k));
    }
  }
  return {slope_scale_ * std::sqrt(squares.to_residual), slope_scale_ * std::sqrt(squares.to_terms)};
}

}  // namespace eigentrail
