// Power series of invariant pairs along the path.
#include <algorithm>
#include <cmath>

#include "core/products.hpp"
#include "core/thin_product.hpp"
#include "modes/series_equations.hpp"

namespace eigentrail {
namespace {

/// Relative size of corrections below which those that do not halve end the refinement, and rounding level.
constexpr double stagnation = 1e-11;
constexpr double rounding = 1e-15;
/// Largest number of corrections of a coefficient of a single pair.
constexpr int most_refinements = 40;

bool are_zero(const MatrixSeries& series) {
  return std::all_of(series.begin(), series.end(), [](const Matrix& B) { return B.isZero(0.0); });
}

/// Products of the blocks of A and B, pair by pair.
ComplexMatrix multiply_blocks(const PairSet& pairs, const ComplexMatrix& A, const ComplexMatrix& B) {
  ComplexMatrix result = ComplexMatrix::Zero(A.rows(), A.cols());
  for (const PairSet::Place& place : pairs.places) {
    result.block(0, place.first, place.size, place.size) =
        thin_product(pairs.block(A, place), pairs.block(B, place));
  }
  return result;
}

}  // namespace

SeriesEquations::SeriesEquations(const ReducedPencil& pencil, Chart chart, const PairSet& pairs, int order)
    : M_(chart == Chart::finite ? pencil.M : pencil.K),
      C_(pencil.C),
      K_(chart == Chart::finite ? pencil.K : pencil.M),
      pairs_(pairs),
      undamped_(are_zero(C_)),
      massless_(are_zero(M_)),
      size_(pairs.Lambda.norm()) {
  if (size_ == 0.0) size_ = 1.0;
  if (pairs.Z.cols() == 1) P_ = PencilAtPoint(pencil, chart).matrix(pairs.Lambda(0, 0));
  const auto count = static_cast<std::size_t>(order) + 1;
  const ComplexMatrix none_Z = ComplexMatrix::Zero(pairs.Z.rows(), pairs.Z.cols());
  const ComplexMatrix none_L = ComplexMatrix::Zero(pairs.Lambda.rows(), pairs.Lambda.cols());
  Z_.assign(count, none_Z);
  Lambda_.assign(count, none_L);
  MZ_.assign(count, none_Z);
  CZ_.assign(count, none_Z);
  square_.assign(count, none_L);
  Z_[0] = pairs.Z;
  Lambda_[0] = pairs.Lambda;
  update(0);
}

int SeriesEquations::solve_for(std::size_t j, int most, double accuracy, const Solve& solve) {
  ComplexMatrix known, known_defect, dZ, dLambda;
  known_terms(j, known, known_defect);
  double last = INFINITY;
  int corrections = 0;
  while (corrections < most) {
    ComplexMatrix residual = known;
    ComplexMatrix defect = known_defect;
    if (corrections > 0) add_unknown_terms(j, residual, defect);
    solve(-residual, -defect, dZ, dLambda);
    make_real(pairs_, dZ, dLambda);
    Z_[j] += dZ;
    Lambda_[j] += dLambda;
    ++corrections;
    const double total = Z_[j].norm() * size_ + Lambda_[j].norm();
    const double size = total > 0.0 ? (dZ.norm() * size_ + dLambda.norm()) / total : 0.0;
    // The first correction is the solution itself, of relative size one. With factors of a distant prediction
    // the next one may be almost as large. Therefore corrections that do not halve end the refinement only
    // below `stagnation`.
    if (!(size > rounding) || (size > 0.5 * last && size < stagnation)) break;
    // Each correction reduces the error by about the same factor, so size^2 / last estimates the remaining
    // error.
    if (std::isfinite(last) && size < 0.1 * last && size * size < accuracy * last) break;
    last = size;
  }
  update(j);
  return corrections;
}

PairSeries SeriesEquations::of(const PairSet::Place& place) const {
  PairSeries series;
  for (std::size_t j = 0; j < Z_.size(); ++j) {
    series.Z.emplace_back(Z_[j].middleCols(place.first, place.size));
    series.Lambda.emplace_back(pairs_.block(Lambda_[j], place));
  }
  return series;
}

/// Coefficient j of the residuals and normalizations with Z_j = Lambda_j = 0.
void SeriesEquations::known_terms(std::size_t j, ComplexMatrix& residual, ComplexMatrix& defect) {
  residual = product(K_, j);
  if (!massless_) {
    MZ_[j] = product(M_, j);
    ComplexMatrix inner = ComplexMatrix::Zero(square_[0].rows(), square_[0].cols());
    for (std::size_t i = 1; i < j; ++i) inner += multiply_blocks(pairs_, Lambda_[i], Lambda_[j - i]);
    residual += with_blocks(pairs_, MZ_[j], square_[0]) + with_blocks(pairs_, MZ_[0], inner);
    for (std::size_t i = 1; i < j; ++i) residual += with_blocks(pairs_, MZ_[j - i], square_[i]);
  }
  if (!undamped_) {
    CZ_[j] = product(C_, j);
    for (std::size_t i = 0; i < j; ++i) residual += with_blocks(pairs_, CZ_[j - i], Lambda_[i]);
  }
  defect = ComplexMatrix::Zero(Lambda_[0].rows(), Lambda_[0].cols());
  for (const PairSet::Place& place : pairs_.places) {
    if (place.size == 1) continue;
    const auto W1 = pairs_.W.bottomRows(pairs_.Z.rows()).middleCols(place.first, place.size);
    auto block = defect.block(0, place.first, place.size, place.size);
    for (std::size_t i = 1; i < j; ++i) {
      block += thin_product(W1.adjoint(), thin_product(Z_[i].middleCols(place.first, place.size),
                                                       pairs_.block(Lambda_[j - i], place)));
    }
  }
}

/// Adds the terms in Z_j and Lambda_j to them.
void SeriesEquations::add_unknown_terms(std::size_t j, ComplexMatrix& residual, ComplexMatrix& defect) const {
  const bool is_single = P_.size() > 0;
  ComplexMatrix slope = ComplexMatrix::Zero(Z_[j].rows(), Z_[j].cols());
  ComplexMatrix by_value = slope;
  if (!massless_) {
    slope = with_blocks(pairs_, MZ_[0], Lambda_[j]);
    by_value = with_blocks(pairs_, MZ_[0], Lambda_[0]);
    if (!is_single) slope += with_blocks(pairs_, multiply(M_[0], Z_[j]), Lambda_[0]);
  }
  if (!undamped_) {
    by_value += CZ_[0];
    if (!is_single) slope += multiply(C_[0], Z_[j]);
  }
  residual += with_blocks(pairs_, slope, Lambda_[0]) + with_blocks(pairs_, by_value, Lambda_[j]);
  residual += is_single ? eigentrail::product(P_, Z_[j]) : multiply(K_[0], Z_[j]);
  const Eigen::Index n = pairs_.Z.rows();
  for (const PairSet::Place& place : pairs_.places) {
    const auto X = Z_[j].middleCols(place.first, place.size);
    const auto W = pairs_.W.middleCols(place.first, place.size);
    auto block = defect.block(0, place.first, place.size, place.size);
    block += thin_product(W.topRows(n).adjoint(), X);
    if (place.size == 1) continue;
    const auto Z0 = Z_[0].middleCols(place.first, place.size);
    const ComplexMatrix ZL =
        thin_product(X, pairs_.block(Lambda_[0], place)) + thin_product(Z0, pairs_.block(Lambda_[j], place));
    block += thin_product(W.bottomRows(n).adjoint(), ZL);
  }
}

/// Adds the terms of Z_j and Lambda_j to the products; to be called after known_terms(j).
void SeriesEquations::update(std::size_t j) {
  if (!massless_) MZ_[j] += multiply(M_[0], Z_[j]);
  if (!undamped_) CZ_[j] += multiply(C_[0], Z_[j]);
  for (std::size_t i = 0; i <= j; ++i) square_[j] += multiply_blocks(pairs_, Lambda_[i], Lambda_[j - i]);
}

/// Coefficient j of B(h) Z(h) without the term B_0 Z_j.
ComplexMatrix SeriesEquations::product(const MatrixSeries& B, std::size_t j) const {
  ComplexMatrix sum = ComplexMatrix::Zero(Z_[0].rows(), Z_[0].cols());
  for (std::size_t i = 1; i <= j && i < B.size(); ++i) sum += multiply(B[i], Z_[j - i]);
  return sum;
}

namespace {

/// Whether new factors at a block itself save time, given that those of the predicted one required
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
  const PairSet alone{{{0, pair.size(), pair.is_real}}, pair.Z, pair.Lambda, pair.W};
  SeriesEquations series(pencil, pair.chart, alone, order);
  const bool is_block = pair.size() > 1;
  const auto solve = [&](const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ,
                         ComplexMatrix& dLambda) {
    factors->solve(R, N, dZ, dLambda);
    counts.solves += static_cast<std::uint64_t>(pair.size());
  };
  for (int j = 1; j <= order; ++j) {
    const int corrections = series.solve_for(static_cast<std::size_t>(j), most_refinements,
                                             is_block ? rounding : accuracy, solve);
    // If the pair had no factors, new ones were computed above at the pair itself; they need no renewal.
    if (is_block && j == 1 && pair.factors && is_worth_factoring(corrections, order - 1, pencil.size())) {
      factors = std::make_shared<const PairFactorization>(point, pair.Z, pair.Lambda, pair.W);
      counts.factorizations += static_cast<std::uint64_t>(pair.size());
    }
  }
  return series.of(alone.places.front());
}

}  // namespace eigentrail
