#include "eigentrail/modes/invariant_pair.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

constexpr int max_refinements = 40;
constexpr double stagnation = 1e-11;
constexpr double rounding = 1e-15;

/// Real matrix times complex matrix of few columns, as real matrix-vector products: a matrix product would
/// first copy B into its own order, which costs more than the few columns themselves.
ComplexMatrix multiply(const Matrix& B, const ComplexMatrix& Z) {
  ComplexMatrix result(B.rows(), Z.cols());
  Vector part(Z.rows()), product(B.rows());
  for (Eigen::Index j = 0; j < Z.cols(); ++j) {
    part = Z.col(j).real();
    product.noalias() = B * part;
    result.col(j).real() = product;
    part = Z.col(j).imag();
    product.noalias() = B * part;
    result.col(j).imag() = product;
  }
  return result;
}

/// Corrects an approximate solution until its corrections stop shrinking or vanish; `correct` returns the
/// size of one correction relative to the solution.
template <class Correct>
void refine(Correct&& correct) {
  double last = INFINITY;
  for (int i = 0; i < max_refinements; ++i) {
    const double size = correct();
    // The first solution is a correction of relative size one, and with factors from a distant prediction the
    // next may not be much smaller: corrections that do not halve end the refinement only at the level of
    // rounding.
    if (!(size > rounding) || (size > 0.5 * last && size < stagnation)) return;
    last = size;
  }
}

double balance(const ComplexMatrix& Lambda) {
  const double size = Lambda.norm();
  return size > 0.0 ? size : 1.0;
}

/// W0^H Z + W1^H Z Lambda.
ComplexMatrix normalization(const ComplexMatrix& W, const ComplexMatrix& Z, const ComplexMatrix& Lambda) {
  return W.topRows(Z.rows()).adjoint() * Z + (W.bottomRows(Z.rows()).adjoint() * Z) * Lambda;
}

void make_real(ComplexMatrix& Z) {
  Z.imag().setZero();
}

}  // namespace

PencilAtPoint::PencilAtPoint(const ReducedPencil& pencil, Chart chart)
    : M(chart == Chart::finite ? pencil.M[0] : pencil.K[0]),
      C(pencil.C[0]),
      K(chart == Chart::finite ? pencil.K[0] : pencil.M[0]),
      norm_M(M.norm()),
      norm_C(C.norm()),
      norm_K(K.norm()) {}

ComplexMatrix PencilAtPoint::matrix(Complex mu) const {
  ComplexMatrix P(M.rows(), M.cols());
  const Complex mu2 = mu * mu;
  P.real() = mu2.real() * M + mu.real() * C + K;
  P.imag() = mu2.imag() * M + mu.imag() * C;
  return P;
}

ComplexMatrix PencilAtPoint::residual(const ComplexMatrix& Z, const ComplexMatrix& Lambda) const {
  return (multiply(M, Z) * Lambda + multiply(C, Z)) * Lambda + multiply(K, Z);
}

double PencilAtPoint::magnitude(double mu) const {
  return (mu * norm_M + norm_C) * mu + norm_K;
}

PairFactorization::PairFactorization(const PencilAtPoint& pencil, const ComplexMatrix& Z,
                                     const ComplexMatrix& Lambda, const ComplexMatrix& W)
    : M_(pencil.M), C_(pencil.C) {
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  if (k == 1) {
    U_ = ComplexMatrix::Identity(1, 1);
    T_ = Lambda;
  } else {
    const Eigen::ComplexSchur<ComplexMatrix> schur(Lambda);
    U_ = schur.matrixU();
    T_ = schur.matrixT().triangularView<Eigen::Upper>();
  }
  T2_ = T_ * T_;
  Z_ = Z * U_;
  W_ = W * U_;
  const ComplexMatrix MZ = multiply(M_, Z_);
  const ComplexMatrix CZ = multiply(C_, Z_);
  const ComplexMatrix WZ = W_.bottomRows(n).adjoint() * Z_;
  // The border gets the size of the terms of P, not of their sum, which vanishes at an eigenvalue when n = 1.
  const double terms = pencil.magnitude(T_.diagonal().cwiseAbs().maxCoeff());
  // Where every term vanishes (a zero eigenvalue without stiffness) the matrices themselves give the scale.
  const double whole = pencil.norm_M + pencil.norm_C + pencil.norm_K;
  const double size = std::max((terms > 0.0 ? terms : whole) / std::sqrt(static_cast<double>(n)), 1e-300);
  const ComplexMatrix slope = 2.0 * MZ * T_ + CZ;
  slope_scale_ = slope.norm() > 0.0 ? size / slope.norm() : size;
  border_scale_ = size;
  columns_.reserve(static_cast<std::size_t>(k));
  for (Eigen::Index j = 0; j < k; ++j) {
    const Complex t = T_(j, j);
    ComplexMatrix B(n + k, n + k);
    B.topLeftCorner(n, n) = pencil.matrix(t);
    B.topRightCorner(n, k) = slope_scale_ * (MZ * (T_ + t * ComplexMatrix::Identity(k, k)) + CZ);
    B.bottomLeftCorner(k, n) = border_scale_ * (W_.topRows(n).adjoint() + t * W_.bottomRows(n).adjoint());
    B.bottomRightCorner(k, k) = border_scale_ * slope_scale_ * WZ;
    columns_.emplace_back(B);
  }
}

void PairFactorization::solve(const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ,
                              ComplexMatrix& dLambda) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  const ComplexMatrix right = R * U_;
  const ComplexMatrix unit = U_.adjoint() * N * U_;
  ComplexMatrix X(n, k), Y(k, k);
  ComplexVector b(n + k);
  for (Eigen::Index j = 0; j < k; ++j) {
    b.head(n) = right.col(j);
    b.tail(k) = unit.col(j);
    if (j > 0) {
      // What the columns before contribute to this one through the triangle of T.
      const auto t = T_.col(j).head(j);
      const ComplexVector Xt = X.leftCols(j) * t;
      b.head(n) -=
          multiply(M_, X.leftCols(j) * T2_.col(j).head(j) + Z_ * (Y.leftCols(j) * t)) + multiply(C_, Xt);
      b.tail(k) -= W_.bottomRows(n).adjoint() * Xt;
    }
    b.tail(k) *= border_scale_;
    const ComplexVector solution = columns_[static_cast<std::size_t>(j)].solve(b);
    X.col(j) = solution.head(n);
    Y.col(j) = slope_scale_ * solution.tail(k);
  }
  dZ = X * U_.adjoint();
  dLambda = U_ * Y * U_.adjoint();
}

double PairFactorization::sensitivity() const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  double square = 0.0;
  for (const auto& lu : columns_) {
    for (Eigen::Index i = 0; i < k; ++i) {
      const ComplexVector y = lu.adjoint().solve(ComplexVector(ComplexVector::Unit(n + k, n + i)));
      square += y.head(n).squaredNorm();
    }
  }
  return slope_scale_ * std::sqrt(square);
}

void normalize_pair(ComplexMatrix& Z, ComplexMatrix& Lambda, ComplexMatrix& W, double reference) {
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  if (k == 1) {
    // One vector needs no help from z s, and linear equations in it converge from farther away.
    Z /= Z.norm();
    W = ComplexMatrix::Zero(2 * n, 1);
    W.topRows(n) = Z;
    return;
  }
  const double gamma = std::max(balance(Lambda), reference);
  ComplexMatrix both(2 * n, k);
  both << Z, Z * Lambda / gamma;
  const Eigen::HouseholderQR<ComplexMatrix> qr(both);
  W = qr.householderQ() * ComplexMatrix::Identity(2 * n, k);
  const ComplexMatrix R = W.adjoint() * both;
  const Eigen::PartialPivLU<ComplexMatrix> lu(R.transpose());
  Z = lu.solve(Z.transpose()).transpose();
  Lambda = lu.solve((R * Lambda).transpose()).transpose();
  W.bottomRows(n) /= gamma;
}

namespace {

/// Chord-Newton on (Z, Lambda); leaves factors at the last pair that was factored.
PairStatus newton(const PencilAtPoint& pencil, double reference, const CorrectorOptions& options,
                  InvariantPair& pair, ModeCounts& counts) {
  const Eigen::Index k = pair.size();
  const auto factor = [&] {
    pair.factors.emplace(pencil, pair.Z, pair.Lambda, pair.W);
    counts.factorizations += static_cast<std::uint64_t>(k);
  };
  factor();
  double last = INFINITY;
  int refactorizations = 0;
  ComplexMatrix dZ, dLambda;
  for (int i = 0; i < options.max_iterations; ++i) {
    const ComplexMatrix defect = ComplexMatrix::Identity(k, k) - normalization(pair.W, pair.Z, pair.Lambda);
    pair.factors->solve(-pencil.residual(pair.Z, pair.Lambda), defect, dZ, dLambda);
    counts.solves += static_cast<std::uint64_t>(k);
    ++counts.iterations;
    if (pair.is_real) {
      make_real(dZ);
      make_real(dLambda);
    }
    pair.Z += dZ;
    pair.Lambda += dLambda;
    const double size =
        std::max(dZ.norm() / pair.Z.norm(), dLambda.norm() / std::max(pair.Lambda.norm(), reference));
    if (!std::isfinite(size)) return PairStatus::singular;
    if (size <= options.tolerance) return PairStatus::converged;
    const double contraction = size / last;
    if (contraction > 0.5 && size < 1e-10) return PairStatus::converged;  // rounding: no longer shrinking
    if (contraction > options.refactor_contraction) {
      if (std::isfinite(last) && contraction > 2.0) return PairStatus::not_converged;
      if (++refactorizations > 6 && contraction > 0.9) return PairStatus::not_converged;
      if (size > 1e-12) factor();
    }
    last = size;
  }
  return PairStatus::not_converged;
}

}  // namespace

InvariantPair correct_pair(const PencilAtPoint& pencil, const InvariantPair& start, double reference,
                           const CorrectorOptions& options, ModeCounts& counts) {
  InvariantPair pair;
  pair.chart = start.chart;
  pair.is_real = start.is_real;
  pair.Z = start.Z;
  pair.Lambda = start.Lambda;
  normalize_pair(pair.Z, pair.Lambda, pair.W, reference);
  if (!pair.Z.allFinite() || !pair.Lambda.allFinite()) {
    pair.status = PairStatus::singular;
    return pair;
  }
  pair.status = newton(pencil, reference, options, pair, counts);
  if (pair.status != PairStatus::converged) return pair;
  const double size = pair.Lambda.norm() / std::sqrt(static_cast<double>(pair.size()));
  const double scale = pencil.magnitude(size) * pair.Z.norm();
  pair.backward_error = scale > 0.0 ? pencil.residual(pair.Z, pair.Lambda).norm() / scale : 0.0;
  pair.condition = pair.factors->sensitivity() * scale / std::max(size, reference);
  counts.solves += static_cast<std::uint64_t>(pair.size() * pair.size());
  return pair;
}

Complex eigenvalue_remainder(const PencilAtPoint& pencil, const InvariantPair& pair) {
  using LongComplex = std::complex<long double>;
  using LongVector = Eigen::Matrix<LongComplex, Eigen::Dynamic, 1>;
  const LongVector z = pair.Z.col(0).cast<LongComplex>();
  const auto mu = static_cast<LongComplex>(pair.Lambda(0, 0));
  const auto times = [&z](const Matrix& B) { return LongVector(B.cast<LongComplex>() * z); };
  const LongVector residual = (times(pencil.M) * mu + times(pencil.C)) * mu + times(pencil.K);
  const ComplexMatrix defect = ComplexMatrix::Identity(1, 1) - normalization(pair.W, pair.Z, pair.Lambda);
  ComplexMatrix dZ, dLambda;
  pair.factors->solve(-residual.cast<Complex>(), defect, dZ, dLambda);
  return dLambda(0, 0);
}

namespace {

/// Coefficients of products of matrix series, filled order by order.
class SeriesEquations {
 public:
  SeriesEquations(const ReducedPencil& pencil, const InvariantPair& pair, int order)
      : M_(pair.chart == Chart::finite ? pencil.M : pencil.K),
        C_(pencil.C),
        K_(pair.chart == Chart::finite ? pencil.K : pencil.M),
        W0_(pair.W.topRows(pair.Z.rows())),
        W1_(pair.W.bottomRows(pair.Z.rows())) {
    const ComplexMatrix none_Z = ComplexMatrix::Zero(pair.Z.rows(), pair.Z.cols());
    const ComplexMatrix none_L = ComplexMatrix::Zero(pair.size(), pair.size());
    const auto count = static_cast<std::size_t>(order) + 1;
    Z.assign(count, none_Z);
    Lambda.assign(count, none_L);
    MZ_.assign(count, none_Z);
    CZ_.assign(count, none_Z);
    Lambda2_.assign(count, none_L);
    Z[0] = pair.Z;
    Lambda[0] = pair.Lambda;
    update(0);
  }

  /// Coefficient j of the residual and of the normalization with Z_j = Lambda_j = 0: the right side,
  /// negative.
  void known_terms(int j, ComplexMatrix& residual, ComplexMatrix& defect) const {
    residual = product(K_, j);
    defect = ComplexMatrix::Zero(Lambda[0].rows(), Lambda[0].cols());
    ComplexMatrix square = defect;
    for (int i = 1; i < j; ++i) square += Lambda[at(i)] * Lambda[at(j - i)];
    residual += product(M_, j) * Lambda2_[0] + product(C_, j) * Lambda[0] + MZ_[0] * square;
    for (int i = 1; i < j; ++i) {
      residual += MZ_[at(j - i)] * Lambda2_[at(i)] + CZ_[at(j - i)] * Lambda[at(i)];
      defect += W1_.adjoint() * (Z[at(i)] * Lambda[at(j - i)]);
    }
  }

  /// What Z_j and Lambda_j add to them.
  void unknown_terms(int j, ComplexMatrix& residual, ComplexMatrix& defect) const {
    const ComplexMatrix& X = Z[at(j)];
    const ComplexMatrix& Y = Lambda[at(j)];
    residual += (multiply(M_[0], X) * Lambda[0] + multiply(C_[0], X)) * Lambda[0] + multiply(K_[0], X) +
                MZ_[0] * (Lambda[0] * Y + Y * Lambda[0]) + CZ_[0] * Y;
    defect += W0_.adjoint() * X + W1_.adjoint() * (X * Lambda[0] + Z[0] * Y);
  }

  /// Takes the coefficients j of Z and Lambda into the products.
  void update(int j) {
    MZ_[at(j)] = product(M_, j) + multiply(M_[0], Z[at(j)]);
    CZ_[at(j)] = product(C_, j) + multiply(C_[0], Z[at(j)]);
    for (int i = 0; i <= j; ++i) Lambda2_[at(j)] += Lambda[at(i)] * Lambda[at(j - i)];
  }

  std::vector<ComplexMatrix> Z, Lambda;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Coefficient j of B(h) Z(h) without the term B_0 Z_j.
  ComplexMatrix product(const MatrixSeries& B, int j) const {
    ComplexMatrix sum = ComplexMatrix::Zero(Z[0].rows(), Z[0].cols());
    for (int i = 1; i <= j && i < static_cast<int>(B.size()); ++i) sum += multiply(B[at(i)], Z[at(j - i)]);
    return sum;
  }

  const MatrixSeries &M_, &C_, &K_;
  ComplexMatrix W0_, W1_;
  std::vector<ComplexMatrix> MZ_, CZ_, Lambda2_;
};

}  // namespace

PairSeries differentiate_pair(const ReducedPencil& pencil, const InvariantPair& pair, int order,
                              ModeCounts& counts) {
  SeriesEquations series(pencil, pair, order);
  const double size = balance(pair.Lambda);
  ComplexMatrix known_residual, known_defect, dZ, dLambda;
  for (int j = 1; j <= order; ++j) {
    const auto at = static_cast<std::size_t>(j);
    series.known_terms(j, known_residual, known_defect);
    refine([&] {
      ComplexMatrix residual = known_residual;
      ComplexMatrix defect = known_defect;
      series.unknown_terms(j, residual, defect);
      pair.factors->solve(-residual, -defect, dZ, dLambda);
      counts.solves += static_cast<std::uint64_t>(pair.size());
      if (pair.is_real) {
        make_real(dZ);
        make_real(dLambda);
      }
      series.Z[at] += dZ;
      series.Lambda[at] += dLambda;
      const double total = series.Z[at].norm() * size + series.Lambda[at].norm();
      return total > 0.0 ? (dZ.norm() * size + dLambda.norm()) / total : 0.0;
    });
    series.update(j);
  }
  return {std::move(series.Z), std::move(series.Lambda)};
}

}  // namespace eigentrail
