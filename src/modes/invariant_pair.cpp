#include "eigentrail/modes/invariant_pair.hpp"
#include "core/orthonormal.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace eigentrail {
namespace {

/// W0^H Z + W1^H Z Lambda.
ComplexMatrix normalization(const ComplexMatrix& W, const ComplexMatrix& Z, const ComplexMatrix& Lambda) {
  if (Z.cols() == 1) return W.topRows(Z.rows()).adjoint() * Z;  // W1 = 0
  return W.topRows(Z.rows()).adjoint() * Z + (W.bottomRows(Z.rows()).adjoint() * Z) * Lambda;
}

/// Scale of the slopes Z Lambda against Z. Two real eigenvalues of one freedom have one vector, so that
/// [Z; Z Lambda / gamma] is orthonormal where Lambda has an entry of the size of gamma; there are at most k /
/// 2 such entries. With |Lambda| itself for gamma it would grow by a factor from point to point where there
/// are several, and rounding with it.
double scale_of_slopes(const ComplexMatrix& Lambda, double reference) {
  if (!Lambda.allFinite()) return reference;
  return std::max(reference, Lambda.norm() / std::sqrt(0.5 * static_cast<double>(Lambda.rows())));
}

/// Smallest share of Z in the orthonormal columns of [Z; Z Lambda / gamma] with which Z is normalized alone.
/// Two vectors at right angles have 1 / sqrt(2) or more, whatever their eigenvalues, and two eigenvalues of
/// one freedom have zero. With a smaller value, vectors that are nearly parallel have to be told apart by Z
/// alone, and the certificate takes more pieces.
constexpr double enough_of_Z = 0.7;

/// Smallest share of one column of [Z; Z Lambda / gamma] beside those before it, of the largest, from which
/// they tell a space. Below, as in a start that is far from a pair, the direction beside them is its error.
constexpr double independent = 1e-3;

using Reflections = Eigen::HouseholderQR<ComplexMatrix>;

ComplexMatrix orthonormal_basis(const Reflections& qr) {
  return columns_of_Q(qr, qr.cols());
}

bool are_independent(const Reflections& qr) {
  const Vector shares = qr.matrixQR().diagonal().cwiseAbs();
  return shares.minCoeff() > independent * shares.maxCoeff();
}

double smallest_singular_value(const ComplexMatrix& columns) {
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(columns.adjoint() * columns),
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(squares.eigenvalues()[0], 0.0));
}

}  // namespace

ModeCounts& ModeCounts::operator+=(const ModeCounts& other) {
  factorizations += other.factorizations;
  iterations += other.iterations;
  solves += other.solves;
  modal_bases += other.modal_bases;
  modal_solves += other.modal_solves;
  return *this;
}

void normalize_pair(ComplexMatrix& Z, ComplexMatrix& Lambda, ComplexMatrix& W, double reference) {
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  if (k == 1) {
    // For a single mode z alone is normalized: the normalization is then linear in z, and Newton's method
    // converges from farther away.
    Z /= Z.norm();
    W = ComplexMatrix::Zero(2 * n, 1);
    W.topRows(n) = Z;
    return;
  }
  const double gamma = scale_of_slopes(Lambda, reference);
  ComplexMatrix both(2 * n, k);
  both << Z, Z * Lambda / gamma;
  const Reflections qr(both);
  W = orthonormal_basis(qr);
  // Where W1 takes part, series of the pair converge only as far as Lambda changes by about gamma. Where all
  // eigenvalues of a block pass through zero that is not far, and depends on the error of their prediction.
  if (are_independent(qr) && smallest_singular_value(W.topRows(n)) > enough_of_Z) {
    W.topRows(n) = orthonormal_basis(Reflections(Z));
    W.bottomRows(n).setZero();
  }
  const ComplexMatrix R = W.adjoint() * both;
  const Eigen::PartialPivLU<ComplexMatrix> lu(R.transpose());
  Z = lu.solve(ComplexMatrix(Z.transpose())).transpose();
  Lambda = lu.solve(ComplexMatrix((R * Lambda).transpose())).transpose();
  W.bottomRows(n) /= gamma;
}

std::shared_ptr<const PairFactorization> factors_of(const PencilAtPoint& pencil, const InvariantPair& pair) {
  if (pair.factors) return pair.factors;
  return std::make_shared<const PairFactorization>(pencil, pair.Z, pair.Lambda, pair.W);
}

namespace {

/// Typical size of the eigenvalues of a pair.
double size_of_eigenvalues(const InvariantPair& pair) {
  return pair.Lambda.norm() / std::sqrt(static_cast<double>(pair.size()));
}

/// Scale of the residuals of a pair: the magnitude of the pencil at the typical size of its eigenvalues,
/// times |Z|.
double residual_scale(const PencilAtPoint& pencil, const InvariantPair& pair) {
  return pencil.magnitude(size_of_eigenvalues(pair)) * pair.Z.norm();
}

/// Relative size of a correction up to which it may be rounding, for a pencil whose terms are not much larger
/// than the change of the pencil with its eigenvalue.
constexpr double correction_rounding = 1e-10;

/// The same where the residual is known to be rounding. Larger corrections would mix other modes into a
/// block.
constexpr double ill_conditioned = 1e-7;

/// By how much rounding of the terms s^2 M, s C, K is magnified in s and z because the pencil changes little
/// with s: |P| / |s P'|. Of the order of one for well-scaled pencils, also at exceptional points.
double magnified_rounding(const PencilAtPoint& pencil, const InvariantPair& pair) {
  const double size = size_of_eigenvalues(pair);
  const double change = (2.0 * size * pencil.norm_M + pencil.norm_C) * size;
  return change > 0.0 ? std::max(1.0, pencil.magnitude(size) / change) : 1.0;
}

/// Whether the residual of a pair is what rounding leaves of it. Where a third eigenvalue is close to a block
/// that is nearly defective, residuals of this size move Z by much more than `correction_rounding`.
bool is_left_by_rounding(const PencilAtPoint& pencil, const InvariantPair& pair,
                         const ComplexMatrix& residual) {
  constexpr double roundings = 10.0;  // products of three matrices and sums of three terms
  return residual.norm() <= roundings * std::numeric_limits<double>::epsilon() * residual_scale(pencil, pair);
}

/// Chord-Newton on (Z, Lambda). Leaves the factors of the last iterate that was factored.
PairStatus newton(const PencilAtPoint& pencil, double reference, const CorrectorOptions& options,
                  InvariantPair& pair, ModeCounts& counts) {
  const Eigen::Index k = pair.size();
  const auto factor = [&] {
    pair.factors = std::make_shared<const PairFactorization>(pencil, pair.Z, pair.Lambda, pair.W);
    counts.factorizations += static_cast<std::uint64_t>(k);
  };
  factor();
  double last = INFINITY;
  int refactorizations = 0;
  ComplexMatrix dZ, dLambda;
  for (int i = 0; i < options.max_iterations; ++i) {
    const ComplexMatrix defect = ComplexMatrix::Identity(k, k) - normalization(pair.W, pair.Z, pair.Lambda);
    const ComplexMatrix residual = pencil.residual(pair.Z, pair.Lambda);
    const bool rounding_is_left = is_left_by_rounding(pencil, pair, residual);
    pair.factors->solve(-residual, defect, dZ, dLambda);
    counts.solves += static_cast<std::uint64_t>(k);
    ++counts.iterations;
    if (pair.is_real) {
      dZ.imag().setZero();
      dLambda.imag().setZero();
    }
    pair.Z += dZ;
    pair.Lambda += dLambda;
    const double size =
        std::max(dZ.norm() / pair.Z.norm(), dLambda.norm() / std::max(pair.Lambda.norm(), reference));
    if (!std::isfinite(size)) return PairStatus::singular;
    if (size <= options.tolerance) return PairStatus::converged;
    const double contraction = size / last;
    // In the chord method the error of a single mode decreases by about the same factor in each iteration.
    if (k == 1 && std::isfinite(last) && contraction < options.refactor_contraction &&
        size * contraction <= 0.1 * options.tolerance)
      return PairStatus::converged;
    // at the rounding level: corrections do not decrease any more
    if (contraction > 0.5 && size < correction_rounding * magnified_rounding(pencil, pair))
      return PairStatus::converged;
    if (contraction > 0.5 && rounding_is_left && size < ill_conditioned) return PairStatus::converged;
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

void remove_remnants(Chart chart, double reference, double tolerance, ComplexMatrix& Lambda) {
  const double least = (chart == Chart::finite ? tolerance * tolerance : tolerance) * reference;
  for (Complex& entry : Lambda.reshaped()) {
    if (std::abs(entry) < least) entry = 0.0;
  }
}

InvariantPair correct_pair(const PencilAtPoint& pencil, const InvariantPair& start, double reference,
                           const CorrectorOptions& options, ModeCounts& counts) {
  InvariantPair pair;
  pair.chart = start.chart;
  pair.part = start.part;
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
  remove_remnants(pair.chart, reference, options.tolerance, pair.Lambda);
  settle_accuracy(pencil, pencil.residual(pair.Z, pair.Lambda).norm(),
                  pair.factors->sensitivity(pencil.terms(pair.Z, pair.Lambda)), reference, pair);
  counts.solves += static_cast<std::uint64_t>(pair.size() * pair.size());
  return pair;
}

void settle_accuracy(const PencilAtPoint& pencil, double residual, const PairSensitivity& sensitivity,
                     double reference, InvariantPair& pair) {
  const double scale = residual_scale(pencil, pair);
  pair.backward_error = scale > 0.0 ? residual / scale : 0.0;
  pair.condition = sensitivity.to_residual * scale / std::max(size_of_eigenvalues(pair), reference);
  pair.rounding = std::numeric_limits<double>::epsilon() * sensitivity.to_terms;
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
  factors_of(pencil, pair)->solve(-residual.cast<Complex>(), defect, dZ, dLambda);
  return dLambda(0, 0);
}

}  // namespace eigentrail
