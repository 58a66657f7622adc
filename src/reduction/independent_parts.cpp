#include "eigentrail/reduction/independent_parts.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/products.hpp"
#include "reduction/balance.hpp"
#include "reduction/free_motions.hpp"
#include "reduction/part_copies.hpp"
#include "reduction/separated_basis.hpp"
#include "reduction/splitting.hpp"

namespace eigentrail {
namespace {

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

/// Parts of matrices T^T A T as parts of the whole: T times their coordinates.
void place_in(const Matrix& T, IndependentParts& parts) {
  const auto place = [&T](Matrix& right, Matrix& left, Matrix& inverse) {
    right = T * right;
    left = T * left;
    inverse = inverse * T.transpose();
  };
  place(parts.right, parts.left, parts.inverse);
  for (IndependentParts::Range& range : parts.ranges) {
    for (PartCopy& copy : range.copies) place(copy.right, copy.left, copy.inverse);
  }
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

}  // namespace eigentrail
