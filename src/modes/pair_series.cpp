// Power series of invariant pairs along the path.
#include <algorithm>
#include <cmath>

#include "core/products.hpp"
#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {
namespace {

/// Limits of the refinement of a coefficient: corrections in all; relative size below which corrections that
/// do not halve end it; rounding level.
constexpr int max_refinements = 40;
constexpr double stagnation = 1e-11;
constexpr double rounding = 1e-15;

/// Refines a solution that begins with zero. `correct(is_first)` makes one correction and returns its size
/// relative to the solution. Stops if corrections do not decrease any more or if the estimated remaining
/// error is below `accuracy`. Returns the number of corrections.
template <class Correct>
int refine(double accuracy, Correct&& correct) {
  double last = INFINITY;
  for (int i = 1; i <= max_refinements; ++i) {
    const double size = correct(i == 1);
    // The first correction is the solution itself, of relative size one. With factors of a distant prediction
    // the next one may be almost as large. Therefore corrections that do not halve end the refinement only
    // below `stagnation`.
    if (!(size > rounding) || (size > 0.5 * last && size < stagnation)) return i;
    // Each correction reduces the error by about the same factor, so size^2 / last estimates the remaining
    // error.
    if (std::isfinite(last) && size < 0.1 * last && size * size < accuracy * last) return i;
    last = size;
  }
  return max_refinements;
}

double size_of(const ComplexMatrix& Lambda) {
  const double size = Lambda.norm();
  return size > 0.0 ? size : 1.0;
}

/// Coefficients of products of matrix series, filled order by order. Products with the few columns of Lambda
/// are Eigen's lazy products; its general product copies the factors into packed form and takes several times
/// as long.
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

  /// Coefficient j of the residual and of the normalization with Z_j = Lambda_j = 0: the negative right side.
  void known_terms(int j, ComplexMatrix& residual, ComplexMatrix& defect) const {
    residual = product(K_, j);
    defect = ComplexMatrix::Zero(Lambda[0].rows(), Lambda[0].cols());
    ComplexMatrix square = defect;
    for (int i = 1; i < j; ++i) square += Lambda[at(i)] * Lambda[at(j - i)];
    residual += product(M_, j).lazyProduct(Lambda2_[0]) + product(C_, j).lazyProduct(Lambda[0]) +
                MZ_[0].lazyProduct(square);
    for (int i = 1; i < j; ++i) {
      residual += MZ_[at(j - i)].lazyProduct(Lambda2_[at(i)]) + CZ_[at(j - i)].lazyProduct(Lambda[at(i)]);
      defect += W1_.adjoint() * Z[at(i)].lazyProduct(Lambda[at(j - i)]);
    }
  }

  /// Adds the terms in Z_j and Lambda_j to them.
  void unknown_terms(int j, ComplexMatrix& residual, ComplexMatrix& defect) const {
    const ComplexMatrix& X = Z[at(j)];
    const ComplexMatrix& Y = Lambda[at(j)];
    const ComplexMatrix slope = multiply(M_[0], X).lazyProduct(Lambda[0]) + multiply(C_[0], X);
    const ComplexMatrix turn = Lambda[0] * Y + Y * Lambda[0];
    residual +=
        slope.lazyProduct(Lambda[0]) + multiply(K_[0], X) + MZ_[0].lazyProduct(turn) + CZ_[0].lazyProduct(Y);
    defect += W0_.adjoint() * X + W1_.adjoint() * (X.lazyProduct(Lambda[0]) + Z[0].lazyProduct(Y));
  }

  /// Adds the terms of Z_j and Lambda_j to the products.
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

/// The same for a single mode, for which all products are vectors.
class ModeEquations {
 public:
  ComplexMatrix Z;   ///< n x (order + 1)
  ComplexVector mu;  ///< order + 1

  ModeEquations(const ReducedPencil& pencil, const PencilAtPoint& point, const InvariantPair& mode, int order)
      : Z(ComplexMatrix::Zero(mode.Z.rows(), order + 1)),
        mu(ComplexVector::Zero(order + 1)),
        M_(mode.chart == Chart::finite ? pencil.M : pencil.K),
        C_(pencil.C),
        K_(mode.chart == Chart::finite ? pencil.K : pencil.M),
        undamped_(point.is_undamped() &&
                  std::all_of(C_.begin() + 1, C_.end(), [](const Matrix& C) { return C.isZero(0.0); })),
        P_(point.matrix(mode.eigenvalue())),
        W0_(mode.W.topRows(mode.Z.rows())),
        MZ_(Z),
        CZ_(Z),
        square_(mu) {
    Z.col(0) = mode.Z;
    mu[0] = mode.eigenvalue();
    update(0);
    slope_ = 2.0 * mu[0] * MZ_.col(0) + CZ_.col(0);
  }

  /// Coefficient j of the residual with Z_j = mu_j = 0.
  ComplexVector known_terms(Eigen::Index j) {
    MZ_.col(j) = sum_of(M_, j);
    if (!undamped_) CZ_.col(j) = sum_of(C_, j);
    Complex square = 0.0;
    for (Eigen::Index i = 1; i < j; ++i) square += mu[i] * mu[j - i];
    ComplexVector residual =
        sum_of(K_, j) + square_[0] * MZ_.col(j) + mu[0] * CZ_.col(j) + square * MZ_.col(0);
    for (Eigen::Index i = 1; i < j; ++i) residual += square_[i] * MZ_.col(j - i) + mu[i] * CZ_.col(j - i);
    return residual;
  }

  /// Adds the terms in Z_j and mu_j to the residual and sets those of the normalization.
  void unknown_terms(Eigen::Index j, ComplexMatrix& residual, ComplexMatrix& defect) const {
    residual += product(P_, ComplexVector(Z.col(j)));
    residual += mu[j] * slope_;
    defect(0, 0) = W0_.dot(Z.col(j));
  }

  /// Adds the terms of Z_j and mu_j to the products; to be called after known_terms(j).
  void update(Eigen::Index j) {
    MZ_.col(j) += multiply(M_[0], Z.col(j));
    if (!undamped_) CZ_.col(j) += multiply(C_[0], Z.col(j));
    for (Eigen::Index i = 0; i <= j; ++i) square_[j] += mu[i] * mu[j - i];
  }

 private:
  /// Coefficient j of B(h) Z(h) without the term B_0 Z_j.
  ComplexVector sum_of(const MatrixSeries& B, Eigen::Index j) const {
    ComplexVector sum = ComplexVector::Zero(Z.rows());
    for (Eigen::Index i = 1; i <= j && i < static_cast<Eigen::Index>(B.size()); ++i)
      sum += multiply(B[static_cast<std::size_t>(i)], Z.col(j - i));
    return sum;
  }

  const MatrixSeries &M_, &C_, &K_;
  bool undamped_;
  ComplexMatrix P_;  ///< the pencil at the eigenvalue, P(mu)
  ComplexVector W0_, slope_;

  ComplexMatrix MZ_, CZ_;
  ComplexVector square_;
};

PairSeries differentiate_mode(const ReducedPencil& pencil, const PencilAtPoint& point,
                              const InvariantPair& mode, const PairFactorization& factors, int order,
                              ModeCounts& counts, double accuracy) {
  ModeEquations series(pencil, point, mode, order);
  const double size = size_of(mode.Lambda);
  ComplexMatrix residual, dZ, dmu, defect;
  for (Eigen::Index j = 1; j <= order; ++j) {
    const ComplexVector known = series.known_terms(j);
    refine(accuracy, [&](bool is_first) {
      residual = known;
      defect = ComplexMatrix::Zero(1, 1);
      if (!is_first) series.unknown_terms(j, residual, defect);
      factors.solve(-residual, -defect, dZ, dmu);
      ++counts.solves;
      if (mode.is_real) {
        dZ.imag().setZero();
        dmu.imag().setZero();
      }
      series.Z.col(j) += dZ;
      series.mu[j] += dmu(0, 0);
      const double total = series.Z.col(j).norm() * size + std::abs(series.mu[j]);
      return total > 0.0 ? (dZ.norm() * size + std::abs(dmu(0, 0))) / total : 0.0;
    });
    series.update(j);
  }
  PairSeries result;
  for (Eigen::Index j = 0; j <= order; ++j) {
    result.Z.emplace_back(series.Z.col(j));
    result.Lambda.emplace_back(ComplexMatrix::Constant(1, 1, series.mu[j]));
  }
  return result;
}

/// Whether new factors at the pair itself save time, given that those of the predicted pair required
/// `corrections` for one coefficient. With its own factors about three suffice.
bool is_worth_factoring(int corrections, int coefficients, Eigen::Index n) {
  constexpr int with_own_factors = 3;
  // an LU of size n takes as long as n / 18 corrections (measured)
  constexpr double size_per_correction = 18.0;
  return (corrections - with_own_factors) * coefficients * size_per_correction > static_cast<double>(n);
}

}  // namespace

PairSeries differentiate_pair(const ReducedPencil& pencil, const InvariantPair& pair, int order,
                              ModeCounts& counts, double accuracy) {
  const PencilAtPoint point(pencil, pair.chart);
  auto factors = factors_of(point, pair);
  if (!pair.factors) counts.factorizations += static_cast<std::uint64_t>(pair.size());
  if (pair.size() == 1) return differentiate_mode(pencil, point, pair, *factors, order, counts, accuracy);
  SeriesEquations series(pencil, pair, order);
  const double size = size_of(pair.Lambda);
  ComplexMatrix known_residual, known_defect, dZ, dLambda;
  for (int j = 1; j <= order; ++j) {
    const auto at = static_cast<std::size_t>(j);
    series.known_terms(j, known_residual, known_defect);
    const int corrections = refine(rounding, [&](bool is_first) {
      ComplexMatrix residual = known_residual;
      ComplexMatrix defect = known_defect;
      if (!is_first) series.unknown_terms(j, residual, defect);
      factors->solve(-residual, -defect, dZ, dLambda);
      counts.solves += static_cast<std::uint64_t>(pair.size());
      if (pair.is_real) {
        dZ.imag().setZero();
        dLambda.imag().setZero();
      }
      series.Z[at] += dZ;
      series.Lambda[at] += dLambda;
      const double total = series.Z[at].norm() * size + series.Lambda[at].norm();
      return total > 0.0 ? (dZ.norm() * size + dLambda.norm()) / total : 0.0;
    });
    series.update(j);
    // If the pair had no factors, new ones were computed above at the pair itself; they need no renewal.
    if (j == 1 && pair.factors && is_worth_factoring(corrections, order - 1, pencil.size())) {
      factors = std::make_shared<const PairFactorization>(point, pair.Z, pair.Lambda, pair.W);
      counts.factorizations += static_cast<std::uint64_t>(pair.size());
    }
  }
  return {std::move(series.Z), std::move(series.Lambda)};
}

}  // namespace eigentrail
