#include "eigentrail/reduction/independent_parts.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/diagonal_blocks.hpp"
#include "core/products.hpp"
#include "reduction/balance.hpp"
#include "reduction/part_copies.hpp"
#include "reduction/separated_basis.hpp"
#include "reduction/splitting.hpp"

namespace eigentrail {
namespace {

/// The least squared cosine between the tangent space and the frame: that of 80 degrees. Closer to a right
/// angle rounding would be magnified by more than six, and a motion of the frame could have no counterpart.
constexpr double least_cosine_squared = 0.03;

/// Entries of a projected orthonormal basis up to which they are rounding. Without them what the constraints
/// keep apart stays apart, and blocks of it are orthonormalized each by itself.
constexpr double negligible_entry = 1e-13;

/// Scaling is left out if all factors lie within this ratio: it would change only rounding.
constexpr double well_scaled = 64.0;
/// The same for first-order equations. Their states are positions and velocities side by side, and the bounds
/// of the certificate are norms of both: with velocities ten times as large it needs twice the
/// factorizations.
constexpr double well_scaled_states = 4.0;

/// Whether the entries of left^T A right are more than rounding, for any of the matrices; within the parts.
Matrix pattern_of(const std::vector<Matrix>& matrices, const IndependentParts& parts, double magnified) {
  const Eigen::Index n = parts.right.cols();
  const Matrix pattern = pattern_of_entries(parts.left, matrices, parts.right, magnified);
  Matrix within = Matrix::Zero(n, n);
  for (const IndependentParts::Range& range : parts.ranges)
    within.block(range.first, range.first, range.size, range.size).setOnes();
  return pattern.cwiseProduct(within);
}

std::shared_ptr<IndependentParts> find_parts(const CoefficientMatrices& coefficients, double magnified) {
  std::vector<Matrix> all;
  for (const auto* matrices : {&coefficients.M, &coefficients.C, &coefficients.K}) {
    for (const Matrix& A : *matrices) {
      if (A.size() > 0 && !A.isZero(0.0) && A.allFinite()) all.push_back(A);
    }
  }
  if (all.empty() || all[0].rows() < 2) return nullptr;
  const Eigen::Index n = all[0].rows();
  const Balance scaling = balance(coefficients, n);
  std::vector<Matrix> given;  // in units of the norms that they have when they are balanced
  for (Matrix& A : all) {
    const Matrix balanced = scaling.of(A);
    const double size = balanced.norm();
    given.emplace_back(A / size);
    A = balanced / size;
  }
  const Splitting splitting = split(all, magnified);
  const bool falls_apart = splitting.sizes.size() > 1;
  const bool first_order = std::all_of(coefficients.M.begin(), coefficients.M.end(),
                                       [](const Matrix& M) { return M.size() == 0 || M.isZero(0.0); });
  if (!falls_apart && scaling.ratio() <= (first_order ? well_scaled_states : well_scaled)) return nullptr;
  auto parts = std::make_shared<IndependentParts>();
  parts->is_diagonal = !falls_apart;
  parts->right = scaling.columns.asDiagonal() * splitting.right;
  parts->left = scaling.rows.asDiagonal() * splitting.left;
  parts->inverse = splitting.right.inverse() * scaling.columns.cwiseInverse().asDiagonal();
  if (!falls_apart) {
    parts->ranges = {{0, n}};
    parts->pattern_M = parts->pattern_C = parts->pattern_K = Matrix::Ones(n, n);
    return parts;
  }
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < splitting.sizes.size(); ++i) {
    parts->ranges.push_back({first, splitting.sizes[i], i});
    first += splitting.sizes[i];
  }
  const double of_entries = magnified_by(splitting, magnified);
  parts->pattern_M = pattern_of(coefficients.M, *parts, of_entries);
  parts->pattern_C = pattern_of(coefficients.C, *parts, of_entries);
  parts->pattern_K = pattern_of(coefficients.K, *parts, of_entries);
  settle_copies(given, magnified, *parts);
  return parts;
}

/// T^T A T. `magnified` is raised to how many times larger than the result the terms are that cancel in it,
/// up to a bound: beyond that, rounding would hide a coupling that matters. A result that is nothing but
/// rounding is zero.
Matrix projected(const Matrix& A, const Matrix& T, double& magnified) {
  constexpr double most = 100.0;
  constexpr double nothing = 1e-14;
  const Matrix result = congruence(T, A, T);
  const double terms = magnitudes_of_terms(T, A, T).norm();
  if (result.norm() <= nothing * terms) return Matrix::Zero(T.cols(), T.cols());
  magnified = std::clamp(terms / result.norm(), magnified, most);
  return result;
}

/// T^T K T without entries that are rounding: of positions and reactions, by which stiffness holds where
/// there is none.
Matrix without_rounding(const Matrix& K, const Matrix& T, const Matrix& changes) {
  constexpr double rounding = 1e-14;
  if (changes.size() == 0) return K;
  const Matrix terms = magnitudes_of_terms(T, changes, T);
  return (K.array().abs() > rounding * terms.array()).select(K, 0.0);
}

std::vector<Matrix> projected(const std::vector<Matrix>& matrices, const Matrix& T, double& magnified) {
  std::vector<Matrix> result;
  for (const Matrix& A : matrices) result.push_back(projected(A, T, magnified));
  return result;
}

/// Changes the coordinates of all parts and of their copies.
template <class Change>
void change_all(IndependentParts& parts, const Change& change) {
  change(parts.right, parts.left, parts.inverse);
  for (IndependentParts::Range& range : parts.ranges) {
    for (PartCopy& copy : range.copies) change(copy.right, copy.left, copy.inverse);
  }
}

/// Parts of matrices T^T A T as parts of the whole: T times their coordinates.
void place_in(const Matrix& T, IndependentParts& parts) {
  change_all(parts, [&T](Matrix& right, Matrix& left, Matrix& inverse) {
    right = T * right;
    left = T * left;
    inverse = inverse * T.transpose();
  });
}

/// Indices of the coordinates of free motions.
std::vector<Eigen::Index> free_motions(const IndependentParts& parts) {
  std::vector<Eigen::Index> result;
  for (const IndependentParts::Range& range : parts.ranges) {
    const Eigen::Index i = range.first;
    if (parts.is_free(range) && parts.pattern_C(i, i) == 0.0) result.push_back(i);
  }
  return result;
}

/// The factor R with which S R has the unit matrix in some of its rows, in their order.
Matrix to_echelon(const Matrix& S) {
  const Eigen::ColPivHouseholderQR<Matrix> qr(S.transpose());
  const auto& pivots = qr.colsPermutation().indices();
  std::vector<Eigen::Index> rows(pivots.begin(), pivots.begin() + S.cols());
  std::sort(rows.begin(), rows.end());
  return Matrix(S(rows, Eigen::all)).inverse();
}

/// The factor R, upper triangular, with which R^T mass R is diagonal. The first columns keep their direction.
Matrix to_independent(const Matrix& mass) {
  const Matrix upper = Eigen::LLT<Matrix>(mass).matrixU();
  return upper.inverse() * upper.diagonal().asDiagonal();
}

bool is_diagonal(const Matrix& mass) {
  constexpr double rounding = 1e-13;
  const Matrix rest = mass - Matrix(mass.diagonal().asDiagonal());
  return rest.norm() <= rounding * mass.norm();
}

/// Columns scaled by powers of two to a mass of about `mean`.
Matrix scaled(const Matrix& S, const Matrix& mass, double mean) {
  const auto factor = [mean](double m) { return std::exp2(std::round(0.5 * std::log2(mean / m))); };
  return S * mass.diagonal().unaryExpr(factor).asDiagonal();
}

/// Free motions are those that no force holds or damps: freedoms with mass only, such as those of a body in
/// space.
/// Replaces the coordinates of the free motions among the parts, which are arbitrary where there are several,
/// by simple ones: each moves as few coordinates of the system as possible, and they stay independent in
/// mass. Nothing is changed where that is impossible. `masses`: all M of the system, n x n.
void simplify_free_motions(const std::vector<Matrix>& masses, IndependentParts& parts) {
  const std::vector<Eigen::Index> free = free_motions(parts);
  if (free.size() < 2 || masses.empty()) return;
  const Matrix before = parts.right(Eigen::all, free);
  if (parts.left(Eigen::all, free) != before) return;  // equations without a potential
  const auto mass_of = [](const Matrix& S, const Matrix& M) { return Matrix(S.transpose() * M * S); };
  const double mean = mass_of(before, masses[0]).diagonal().mean();
  Matrix S = before * to_echelon(before);
  S = S * to_independent(mass_of(S, masses[0]));
  S = scaled(S, mass_of(S, masses[0]), mean);
  const bool independent = S.allFinite() && std::all_of(masses.begin(), masses.end(), [&](const Matrix& M) {
                             return is_diagonal(mass_of(S, M));
                           });
  if (!independent) return;
  const Matrix change = before.colPivHouseholderQr().solve(S);  // S = before * change
  parts.inverse(free, Eigen::all) = change.inverse() * Matrix(parts.inverse(free, Eigen::all));
  parts.right(Eigen::all, free) = S;
  parts.left(Eigen::all, free) = S;
}

/// The frames at all places that are closest to the tangent space of one of them; empty if there is a place
/// that has turned too far. The place is that from which the others have turned least.
std::vector<Matrix> common_frames(const std::vector<PlaceOnPath>& places) {
  std::vector<Matrix> best;
  double least_turn = std::numeric_limits<double>::infinity();
  for (const PlaceOnPath& at : places) {
    const Matrix frame = separated_basis(at.constraints);
    std::vector<Matrix> frames;
    double turn = 0.0;
    for (const PlaceOnPath& there : places) {
      auto T = turned_frame(there.constraints, frame);
      if (!T) break;
      turn = std::max(turn, (*T - frame).norm());
      frames.push_back(std::move(*T));
    }
    if (frames.size() < places.size() || turn >= least_turn) continue;
    least_turn = turn;
    best = std::move(frames);
    best.push_back(frame);
  }
  return best;
}

}  // namespace

Eigen::Index IndependentParts::freedoms() const {
  Eigen::Index count = 0;
  for (const Range& range : ranges) {
    if (range.complex_sign >= 0) count += range.size * static_cast<Eigen::Index>(1 + range.copies.size());
  }
  return count;
}

std::shared_ptr<const IndependentParts> find_independent_parts(const CoefficientMatrices& coefficients) {
  const auto parts = find_parts(coefficients, 1.0);
  if (parts != nullptr && parts->falls_apart()) simplify_free_motions(coefficients.M, *parts);
  return parts;
}

std::shared_ptr<const IndependentParts> find_independent_parts(const CoefficientMatrices& coefficients,
                                                               const Matrix& T, const Matrix& changes) {
  double magnified = 1.0;
  CoefficientMatrices inner{projected(coefficients.M, T, magnified), projected(coefficients.C, T, magnified),
                            projected(coefficients.K, T, magnified)};
  for (Matrix& K : inner.K) K = without_rounding(K, T, changes);
  const auto within = find_parts(inner, magnified);
  if (within == nullptr || !within->falls_apart()) return nullptr;
  place_in(T, *within);
  simplify_free_motions(coefficients.M, *within);
  return within;
}

std::shared_ptr<const IndependentParts> find_turning_parts(const std::vector<PlaceOnPath>& places) {
  const std::vector<Matrix> frames = common_frames(places);
  if (frames.empty() || frames.back().cols() < 2) return nullptr;
  double magnified = 1.0;
  CoefficientMatrices inner;
  for (std::size_t i = 0; i < places.size(); ++i) {
    inner.M.push_back(projected(places[i].M, frames[i], magnified));
    inner.C.push_back(projected(places[i].C, frames[i], magnified));
    inner.K.push_back(
        without_rounding(projected(places[i].K, frames[i], magnified), frames[i], places[i].changes));
  }
  const auto within = find_parts(inner, magnified);
  if (within == nullptr || !within->falls_apart()) return nullptr;
  place_in(frames.back(), *within);
  within->frame = frames.back();
  return within;
}

std::optional<Matrix> turned_frame(const ConstraintFactorization& constraints, const Matrix& frame) {
  if (constraints.rank() + frame.cols() != frame.rows()) return std::nullopt;
  Matrix T = constraints.allowed_part(frame);
  T = (T.array().abs() > negligible_entry).select(T, 0.0).eval();
  for (const DiagonalBlock& block : diagonal_blocks(MatrixSeries{T})) {
    const Matrix P = T(block.rows, block.columns);
    const Eigen::SelfAdjointEigenSolver<Matrix> gram(transposed_product(P, P));
    if (gram.info() != Eigen::Success || !(gram.eigenvalues()[0] > least_cosine_squared)) return std::nullopt;
    T(block.rows, block.columns) = product(P, Matrix(gram.operatorInverseSqrt()));
  }
  return T;
}

std::shared_ptr<const IndependentParts> turned(const std::shared_ptr<const IndependentParts>& parts,
                                               const ConstraintFactorization& constraints) {
  if (parts->frame.size() == 0) return parts;
  std::optional<Matrix> T = turned_frame(constraints, parts->frame);
  if (!T) return nullptr;
  auto there = std::make_shared<IndependentParts>(*parts);
  change_all(*there, [&](Matrix& right, Matrix& left, Matrix& inverse) {
    right = *T * (parts->frame.transpose() * right);
    left = *T * (parts->frame.transpose() * left);
    inverse = (inverse * parts->frame) * T->transpose();
  });
  there->frame = std::move(*T);
  return there;
}

}  // namespace eigentrail
