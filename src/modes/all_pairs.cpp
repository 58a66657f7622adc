#include "eigentrail/modes/all_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "core/thin_product.hpp"

namespace eigentrail {
namespace {

/// Limits of the corrector; beyond them the pairs are corrected one by one.
constexpr int most_refactorizations = 4;
/// Larger blocks are corrected one by one: clusters of three and more need the full accuracy of their own
/// factors.
constexpr Eigen::Index largest_block = 2;

/// Columns of `Z` times the blocks of `Lambda`, pair by pair.
void times_blocks(const PairSet& pairs, const ComplexMatrix& Lambda, ComplexMatrix& Z) {
  for (const PairSet::Place& place : pairs.places) {
    auto columns = Z.middleCols(place.first, place.size);
    if (place.size == 1) {
      columns *= Lambda(0, place.first);
    } else {
      columns = thin_product(columns, pairs.block(Lambda, place));
    }
  }
}

ComplexMatrix with_blocks(const PairSet& pairs, ComplexMatrix Z, const ComplexMatrix& Lambda) {
  times_blocks(pairs, Lambda, Z);
  return Z;
}

}  // namespace

ComplexMatrix residual(const Matrix& M, const Matrix& C, const Matrix& K, const PairSet& pairs) {
  ComplexMatrix slope = ComplexMatrix::Zero(pairs.Z.rows(), pairs.Z.cols());
  if (!M.isZero(0.0)) slope = with_blocks(pairs, multiply_many(M, pairs.Z), pairs.Lambda);
  if (!C.isZero(0.0)) slope += multiply_many(C, pairs.Z);
  times_blocks(pairs, pairs.Lambda, slope);
  return slope + multiply_many(K, pairs.Z);
}

ComplexMatrix residual(const PencilAtPoint& pencil, const PairSet& pairs) {
  return residual(pencil.M, pencil.C, pencil.K, pairs);
}

namespace {

/// Products of the blocks of A and B, pair by pair.
ComplexMatrix multiply_blocks(const PairSet& pairs, const ComplexMatrix& A, const ComplexMatrix& B) {
  ComplexMatrix product = ComplexMatrix::Zero(A.rows(), A.cols());
  for (const PairSet::Place& place : pairs.places) {
    product.block(0, place.first, place.size, place.size) = pairs.block(A, place) * pairs.block(B, place);
  }
  return product;
}

/// I - (W0^H Z + W1^H Z Lambda), pair by pair.
ComplexMatrix normalization_defect(const PairSet& pairs) {
  const Eigen::Index n = pairs.Z.rows();
  ComplexMatrix defect = ComplexMatrix::Zero(pairs.Lambda.rows(), pairs.Lambda.cols());
  for (const PairSet::Place& place : pairs.places) {
    const auto Z = pairs.Z.middleCols(place.first, place.size);
    const auto W = pairs.W.middleCols(place.first, place.size);
    auto block = defect.block(0, place.first, place.size, place.size);
    block.setIdentity();
    block -= thin_product(W.topRows(n).adjoint(), Z);
    if (place.size > 1)
      block -= thin_product(thin_product(W.bottomRows(n).adjoint(), Z), pairs.block(pairs.Lambda, place));
  }
  return defect;
}

void make_real(const PairSet& pairs, ComplexMatrix& Z, ComplexMatrix& Lambda) {
  for (const PairSet::Place& place : pairs.places) {
    if (!place.is_real) continue;
    Z.middleCols(place.first, place.size).imag().setZero();
    Lambda.middleCols(place.first, place.size).imag().setZero();
  }
}

PairSet side_by_side(const std::vector<InvariantPair>& starts, double reference) {
  PairSet set;
  Eigen::Index columns = 0, largest = 1;
  for (const InvariantPair& start : starts) {
    set.places.push_back({columns, start.size(), start.is_real});
    columns += start.size();
    largest = std::max(largest, start.size());
  }
  const Eigen::Index n = starts.front().Z.rows();
  set.Z.resize(n, columns);
  set.W.resize(2 * n, columns);
  set.Lambda = ComplexMatrix::Zero(largest, columns);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    ComplexMatrix Z = starts[i].Z;
    ComplexMatrix Lambda = starts[i].Lambda;
    ComplexMatrix W;
    normalize_pair(Z, Lambda, W, reference);
    const PairSet::Place& place = set.places[i];
    set.Z.middleCols(place.first, place.size) = Z;
    set.W.middleCols(place.first, place.size) = W;
    set.Lambda.block(0, place.first, place.size, place.size) = Lambda;
  }
  return set;
}

/// Largest relative change of a pair, measured as in the corrector of a single pair.
double largest_change(const PairSet& pairs, const ComplexMatrix& dZ, const ComplexMatrix& dLambda,
                      double reference) {
  double largest = 0.0;
  for (const PairSet::Place& place : pairs.places) {
    const double of_Z =
        dZ.middleCols(place.first, place.size).norm() / pairs.Z.middleCols(place.first, place.size).norm();
    const double of_Lambda =
        pairs.block(dLambda, place).norm() / std::max(pairs.block(pairs.Lambda, place).norm(), reference);
    const double change = std::max(of_Z, of_Lambda);
    if (!std::isfinite(change)) return change;
    largest = std::max(largest, change);
  }
  return largest;
}

bool has_blocks(const PairSet& pairs) {
  return std::any_of(pairs.places.begin(), pairs.places.end(),
                     [](const PairSet::Place& place) { return place.size > 1; });
}

/// Chord-Newton on all pairs. Afterwards `basis` is the basis of the last iterate that was factored, close to
/// the corrected pairs.
bool newton(const PencilAtPoint& pencil, double reference, const CorrectorOptions& options, PairSet& pairs,
            std::optional<Matrix>& leading_inverse, std::optional<ModalBasis>& basis, ModeCounts& counts) {
  const auto factor = [&] {
    basis = ModalBasis::from(pencil, pairs, leading_inverse);
    ++counts.modal_bases;
    if (basis) basis->prepare_division(pairs);
    return basis.has_value();
  };
  if (!factor()) return false;
  // Blocks may be nearly defective, so they are iterated to the rounding level.
  const bool all_single = !has_blocks(pairs);
  double last = INFINITY;
  int refactorizations = 0;
  ComplexMatrix dZ, dLambda;
  for (int i = 0; i < options.max_iterations; ++i) {
    basis->solve(pairs, -residual(pencil, pairs), normalization_defect(pairs), dZ, dLambda);
    counts.modal_solves += 1;
    counts.iterations += pairs.places.size();
    make_real(pairs, dZ, dLambda);
    pairs.Z += dZ;
    pairs.Lambda += dLambda;
    const double size = largest_change(pairs, dZ, dLambda, reference);
    if (!std::isfinite(size)) return false;
    const double contraction = size / last;
    // Second condition: corrections at the rounding level do not decrease any more.
    if (size <= options.tolerance || (contraction > 0.5 && size < 1e-10)) return true;
    // In the chord method the error of single modes decreases by about the same factor in each iteration.
    if (all_single && std::isfinite(last) && contraction < options.refactor_contraction &&
        size * contraction <= 0.1 * options.tolerance)
      return true;
    if (contraction > options.refactor_contraction) {
      if (contraction > 2.0 || ++refactorizations > most_refactorizations || !factor()) return false;
    }
    last = size;
  }
  return false;
}

}  // namespace

bool is_complete(const std::vector<InvariantPair>& pairs, Eigen::Index states) {
  Eigen::Index columns = 0;
  for (const InvariantPair& pair : pairs) {
    if (pair.chart != Chart::finite || pair.size() > largest_block) return false;
    columns += pair.size() * (pair.is_real ? 1 : 2);
  }
  return columns == states;
}

std::shared_ptr<const AllPairs> correct_all(const PencilAtPoint& pencil,
                                            const std::vector<InvariantPair>& starts, double reference,
                                            const CorrectorOptions& options, ModeCounts& counts,
                                            std::vector<InvariantPair>& corrected) {
  PairSet pairs = side_by_side(starts, reference);
  if (!pairs.Z.allFinite() || !pairs.Lambda.allFinite()) return nullptr;
  std::optional<Matrix> leading_inverse;
  std::optional<ModalBasis> basis;
  if (!newton(pencil, reference, options, pairs, leading_inverse, basis, counts)) return nullptr;
  remove_remnants(starts.front().chart, reference, options.tolerance, pairs.Lambda);
  basis = ModalBasis::from(pencil, pairs, leading_inverse);
  ++counts.modal_bases;
  if (!basis) return nullptr;
  basis->prepare_division(pairs);
  const ComplexMatrix R = residual(pencil, pairs);
  corrected.clear();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const PairSet::Place& place = pairs.places[i];
    InvariantPair pair;
    pair.status = PairStatus::converged;
    pair.is_real = place.is_real;
    pair.Z = pairs.Z.middleCols(place.first, place.size);
    pair.Lambda = pairs.block(pairs.Lambda, place);
    pair.W = pairs.W.middleCols(place.first, place.size);
    settle_accuracy(pencil, R.middleCols(place.first, place.size).norm(),
                    basis->sensitivity(place, pencil.terms(pair.Z, pair.Lambda)), reference, pair);
    corrected.push_back(std::move(pair));
  }
  return std::make_shared<const AllPairs>(AllPairs{std::move(pairs), std::move(*basis)});
}

namespace {

/// Coefficients of products of the series of all pairs, filled order by order; as ModeEquations for a single
/// mode.
class AllEquations {
 public:
  std::vector<ComplexMatrix> Z, Lambda;

  AllEquations(const ReducedPencil& pencil, const PairSet& pairs, int order)
      : pencil_(pencil), pairs_(pairs), undamped_(are_zero(pencil.C)), massless_(are_zero(pencil.M)) {
    const auto count = static_cast<std::size_t>(order) + 1;
    const ComplexMatrix none_Z = ComplexMatrix::Zero(pairs.Z.rows(), pairs.Z.cols());
    const ComplexMatrix none_L = ComplexMatrix::Zero(pairs.Lambda.rows(), pairs.Lambda.cols());
    Z.assign(count, none_Z);
    Lambda.assign(count, none_L);
    MZ_.assign(count, none_Z);
    CZ_.assign(count, none_Z);
    square_.assign(count, none_L);
    Z[0] = pairs.Z;
    Lambda[0] = pairs.Lambda;
    update(0);
  }

  /// Coefficient j of the residuals and normalizations with Z_j = Lambda_j = 0.
  void known_terms(std::size_t j, ComplexMatrix& residual, ComplexMatrix& defect) {
    if (!massless_) MZ_[j] = product(pencil_.M, j);
    if (!undamped_) CZ_[j] = product(pencil_.C, j);
    residual = product(pencil_.K, j);
    if (!massless_) {
      ComplexMatrix inner = ComplexMatrix::Zero(square_[0].rows(), square_[0].cols());
      for (std::size_t i = 1; i < j; ++i) inner += multiply_blocks(pairs_, Lambda[i], Lambda[j - i]);
      residual += with_blocks(pairs_, MZ_[j], square_[0]) + with_blocks(pairs_, MZ_[0], inner);
      for (std::size_t i = 1; i < j; ++i) residual += with_blocks(pairs_, MZ_[j - i], square_[i]);
    }
    if (!undamped_) {
      for (std::size_t i = 0; i < j; ++i) residual += with_blocks(pairs_, CZ_[j - i], Lambda[i]);
    }
    defect = ComplexMatrix::Zero(Lambda[0].rows(), Lambda[0].cols());
    const Eigen::Index n = pairs_.Z.rows();
    for (const PairSet::Place& place : pairs_.places) {
      if (place.size == 1) continue;
      const auto W1 = pairs_.W.bottomRows(n).middleCols(place.first, place.size);
      auto block = defect.block(0, place.first, place.size, place.size);
      for (std::size_t i = 1; i < j; ++i) {
        block += thin_product(W1.adjoint(), thin_product(Z[i].middleCols(place.first, place.size),
                                                         pairs_.block(Lambda[j - i], place)));
      }
    }
  }

  /// Adds the terms in Z_j and Lambda_j to them.
  void unknown_terms(std::size_t j, ComplexMatrix& residual, ComplexMatrix& defect) const {
    const PencilAtPoint pencil(pencil_);
    ComplexMatrix slope = ComplexMatrix::Zero(Z[j].rows(), Z[j].cols());
    ComplexMatrix by_value = slope;
    if (!massless_) {
      slope = with_blocks(pairs_, multiply_many(pencil.M, Z[j]), Lambda[0]);
      slope += with_blocks(pairs_, MZ_[0], Lambda[j]);
      by_value = with_blocks(pairs_, MZ_[0], Lambda[0]);
    }
    if (!undamped_) {
      slope += multiply_many(pencil.C, Z[j]);
      by_value += CZ_[0];
    }
    residual += with_blocks(pairs_, slope, Lambda[0]) + multiply_many(pencil.K, Z[j]);
    residual += with_blocks(pairs_, by_value, Lambda[j]);
    const Eigen::Index n = pairs_.Z.rows();
    for (const PairSet::Place& place : pairs_.places) {
      const auto X = Z[j].middleCols(place.first, place.size);
      const auto W = pairs_.W.middleCols(place.first, place.size);
      auto block = defect.block(0, place.first, place.size, place.size);
      block += thin_product(W.topRows(n).adjoint(), X);
      if (place.size == 1) continue;
      const auto Z0 = Z[0].middleCols(place.first, place.size);
      const ComplexMatrix ZL =
          thin_product(X, pairs_.block(Lambda[0], place)) + thin_product(Z0, pairs_.block(Lambda[j], place));
      block += thin_product(W.bottomRows(n).adjoint(), ZL);
    }
  }

  /// Adds the terms of Z_j and Lambda_j to the products; to be called after known_terms(j).
  void update(std::size_t j) {
    if (!massless_) MZ_[j] += multiply_many(pencil_.M[0], Z[j]);
    if (!undamped_) CZ_[j] += multiply_many(pencil_.C[0], Z[j]);
    for (std::size_t i = 0; i <= j; ++i) square_[j] += multiply_blocks(pairs_, Lambda[i], Lambda[j - i]);
  }

 private:
  static bool are_zero(const MatrixSeries& series) {
    return std::all_of(series.begin(), series.end(), [](const Matrix& B) { return B.isZero(0.0); });
  }

  /// Coefficient j of B(h) Z(h) without the term B_0 Z_j.
  ComplexMatrix product(const MatrixSeries& B, std::size_t j) const {
    ComplexMatrix sum = ComplexMatrix::Zero(Z[0].rows(), Z[0].cols());
    for (std::size_t i = 1; i <= j && i < B.size(); ++i) sum += multiply_many(B[i], Z[j - i]);
    return sum;
  }

  const ReducedPencil& pencil_;
  const PairSet& pairs_;
  bool undamped_, massless_;
  std::vector<ComplexMatrix> MZ_, CZ_, square_;
};

}  // namespace

std::vector<PairSeries> differentiate_all(const ReducedPencil& pencil, const AllPairs& all, int order,
                                          double accuracy, ModeCounts& counts) {
  const PairSet& pairs = all.set;
  AllEquations series(pencil, pairs, order);
  // The basis is that of the corrected pairs: one solution is accurate to rounding, and one more refines it.
  // Blocks may be nearly defective; they are refined to the rounding level.
  const int most = has_blocks(pairs) ? 6 : all.basis.rounding() <= accuracy ? 1 : 2;
  ComplexMatrix known, known_defect, dZ, dLambda;
  for (std::size_t j = 1; j < series.Z.size(); ++j) {
    series.known_terms(j, known, known_defect);
    double last = INFINITY;
    for (int i = 0; i < most; ++i) {
      ComplexMatrix residual = known;
      ComplexMatrix defect = known_defect;
      if (i > 0) series.unknown_terms(j, residual, defect);
      all.basis.solve(pairs, -residual, -defect, dZ, dLambda);
      ++counts.modal_solves;
      make_real(pairs, dZ, dLambda);
      series.Z[j] += dZ;
      series.Lambda[j] += dLambda;
      const double total = series.Z[j].norm() + series.Lambda[j].norm();
      const double size = dZ.norm() + dLambda.norm();
      // Each correction reduces the error by about the same factor, so size^2 / last estimates the remaining
      // error.
      if (!(size > 1e-15 * total) || size > 0.5 * last || (i > 0 && size * size < 1e-16 * total * last))
        break;
      last = size;
    }
    series.update(j);
  }
  std::vector<PairSeries> result(pairs.places.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const PairSet::Place& place = pairs.places[i];
    for (std::size_t j = 0; j < series.Z.size(); ++j) {
      result[i].Z.emplace_back(series.Z[j].middleCols(place.first, place.size));
      result[i].Lambda.emplace_back(pairs.block(series.Lambda[j], place));
    }
  }
  return result;
}

}  // namespace eigentrail
