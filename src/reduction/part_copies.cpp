#include "reduction/part_copies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/products.hpp"
#include "reduction/splitting.hpp"

namespace eigentrail {
namespace {

/// Relative difference of eigenvalues, and of matrices in units of their terms, up to which parts of one
/// freedom are equal. Mistuning of 1e-10 makes different parts.
constexpr double equal = 1e-12;

/// The matrices left^T A right of a part, and the eigenvectors of B^-1 G for two random combinations of them.
struct OwnMatrices {
  std::vector<Matrix> all;
  Matrix B;
  ComplexVector values;
  ComplexMatrix V;
};

/// All parts get the same combinations from the same `random`.
OwnMatrices own_matrices(const std::vector<Matrix>& all, const Matrix& left, const Matrix& right,
                         Random random) {
  OwnMatrices own;
  for (const Matrix& A : all) own.all.push_back(congruence(left, A, right));
  own.B = random_combination(own.all, random);
  const Eigen::EigenSolver<Matrix> eigen(
      Matrix(own.B.partialPivLu().solve(random_combination(own.all, random))));
  own.values = eigen.eigenvalues();
  own.V = eigen.eigenvectors();
  return own;
}

bool have_equal_eigenvalues(const OwnMatrices& a, const OwnMatrices& b, double magnified) {
  if (a.values.size() != b.values.size()) return false;
  const double distance =
      magnified * equal * static_cast<double>(a.values.size()) * a.values.cwiseAbs().maxCoeff();
  return std::all_of(b.values.begin(), b.values.end(),
                     [&](Complex s) { return (a.values.array() - s).abs().minCoeff() <= distance; });
}

/// Columns of V in the order in which their eigenvalues are nearest to `order`; empty if two of these have
/// the same.
ComplexMatrix ordered(const ComplexMatrix& V, const ComplexVector& values, const ComplexVector& order) {
  ComplexMatrix result(V.rows(), V.cols());
  std::vector<bool> taken(static_cast<std::size_t>(values.size()), false);
  for (Eigen::Index i = 0; i < order.size(); ++i) {
    Eigen::Index nearest = 0;
    (values.array() - order[i]).abs().minCoeff(&nearest);
    if (taken[static_cast<std::size_t>(nearest)]) return {};
    taken[static_cast<std::size_t>(nearest)] = true;
    result.col(i) = V.col(nearest);
  }
  return result;
}

/// Factors d of eigenvectors with H_b diag(d) = diag(d) H_a, where the two matrices are similar by a diagonal
/// one. The factors of eigenvectors that no entry connects are independent of each other; the first of them,
/// and of the conjugates, is one.
ComplexVector factors_of_vectors(const ComplexMatrix& H_a, const ComplexMatrix& H_b) {
  const Eigen::Index n = H_a.rows();
  ComplexVector d = ComplexVector::Ones(n);
  std::vector<bool> known(static_cast<std::size_t>(n), false);
  const double least = 1e-6 * H_a.norm();  // smaller entries are inaccurate
  for (Eigen::Index done = 0; done < n; ++done) {
    // The largest entry between a known and an unknown one; without such, another component begins.
    double largest = least;
    Eigen::Index from = -1, to = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; known[static_cast<std::size_t>(i)] && j < n; ++j) {
        const double size = std::max(std::abs(H_a(i, j)), std::abs(H_a(j, i)));
        if (known[static_cast<std::size_t>(j)] || size <= largest) continue;
        largest = size;
        from = i;
        to = j;
      }
    }
    if (to < 0) {
      to = std::find(known.begin(), known.end(), false) - known.begin();
    } else if (std::abs(H_a(from, to)) > std::abs(H_a(to, from))) {
      d[to] = d[from] * H_a(from, to) / H_b(from, to);
    } else {
      d[to] = d[from] * H_b(to, from) / H_a(to, from);
    }
    known[static_cast<std::size_t>(to)] = true;
  }
  return d;
}

/// Matrices (S, Y) with Y^T A_b S = A_a for all matrices of two parts, of about equal norms, as far as the
/// eigenvectors give them.
std::optional<std::pair<Matrix, Matrix>> change_of_coordinates(const OwnMatrices& a, const OwnMatrices& b,
                                                               Random random) {
  const ComplexMatrix V_b = ordered(b.V, b.values, a.values);
  if (V_b.size() == 0) return std::nullopt;
  const auto in_vectors = [&random](const OwnMatrices& part, const ComplexMatrix& V) {
    Random same = random;
    const Matrix H = part.B.partialPivLu().solve(random_combination(part.all, same));
    return ComplexMatrix(V.partialPivLu().solve(H.cast<Complex>() * V));
  };
  const ComplexVector d = factors_of_vectors(in_vectors(a, a.V), in_vectors(b, V_b));
  if (!d.allFinite() || !(d.cwiseAbs().minCoeff() > 0.0)) return std::nullopt;
  ComplexMatrix complex_S = V_b * d.asDiagonal() * a.V.inverse();
  // The first factor leaves a complex number open, with which S is real.
  Eigen::Index row = 0, column = 0;
  const double largest = complex_S.cwiseAbs().maxCoeff(&row, &column);
  complex_S *= std::conj(complex_S(row, column)) / largest;
  Matrix S = complex_S.real();
  if (!(complex_S.imag().norm() <= 1e-6 * S.norm())) return std::nullopt;
  Matrix Y = (b.B * S * a.B.inverse()).inverse().transpose();
  const double scale = std::sqrt(Y.norm() / S.norm());
  S *= scale;
  Y /= scale;
  if (!S.allFinite() || !Y.allFinite()) return std::nullopt;
  // Where both are the same up to rounding, equations and coordinates keep their symmetry.
  if ((S - Y).norm() <= 1e-9 * S.norm()) Y = S;
  return std::pair(std::move(S), std::move(Y));
}

/// A part in coordinates in which it equals part `a`; empty if there are none.
std::optional<PartCopy> as_copy(const std::vector<Matrix>& all, const OwnMatrices& a, const OwnMatrices& b,
                                const PartCopy& part, double magnified, Random random) {
  const auto change = change_of_coordinates(a, b, random);
  if (!change) return std::nullopt;
  const auto& [S, Y] = *change;
  PartCopy copy{without_rounding_of_columns(part.right * S), without_rounding_of_columns(part.left * Y),
                S.inverse() * part.inverse};
  const double allowed = magnified * equal * static_cast<double>(S.rows());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Matrix difference = congruence(copy.left, all[k], copy.right) - a.all[k];
    const double terms = magnitudes_of_terms(copy.left, all[k], copy.right).norm();
    if (!(difference.norm() <= allowed * std::max(terms, a.all[k].norm()))) return std::nullopt;
  }
  return copy;
}

PartCopy coordinates_of(const IndependentParts& parts, const IndependentParts::Range& range) {
  return {parts.right.middleCols(range.first, range.size), parts.left.middleCols(range.first, range.size),
          parts.inverse.middleRows(range.first, range.size)};
}

/// Leaves out the coordinates of parts that have become copies.
void keep_only(const std::vector<std::size_t>& kept, IndependentParts& parts) {
  std::vector<Eigen::Index> coordinates;
  std::vector<IndependentParts::Range> ranges;
  std::vector<std::size_t> number(parts.count(), 0);
  for (const std::size_t i : kept) {
    IndependentParts::Range& range = parts.ranges[i];
    number[i] = ranges.size();
    for (Eigen::Index k = 0; k < range.size; ++k) coordinates.push_back(range.first + k);
    range.first = static_cast<Eigen::Index>(coordinates.size()) - range.size;
    range.like = number[range.like];
    ranges.push_back(std::move(range));
  }
  parts.ranges = std::move(ranges);
  for (Matrix* columns : {&parts.right, &parts.left}) *columns = (*columns)(Eigen::all, coordinates).eval();
  parts.inverse = parts.inverse(coordinates, Eigen::all).eval();
  for (Matrix* pattern : {&parts.pattern_M, &parts.pattern_C, &parts.pattern_K})
    *pattern = (*pattern)(coordinates, coordinates).eval();
}

}  // namespace

void settle_copies(const std::vector<Matrix>& all, double magnified, IndependentParts& parts) {
  constexpr std::uint64_t seed = 20102;
  const Random random(seed);
  Random another = random;
  another.discard(1000);
  std::vector<OwnMatrices> own;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < parts.count(); ++i) {
    IndependentParts::Range& range = parts.ranges[i];
    const PartCopy coordinates = coordinates_of(parts, range);
    own.push_back(own_matrices(all, coordinates.left, coordinates.right, random));
    const auto is_same = [&](const OwnMatrices& other) {
      return have_equal_eigenvalues(own.back(), other, magnified);
    };
    range.like = static_cast<std::size_t>(std::find_if(own.begin(), own.end(), is_same) - own.begin());
    std::optional<PartCopy> copy;
    if (range.like < i && !parts.is_free(range))
      copy = as_copy(all, own[range.like], own[i], coordinates, magnified, another);
    if (copy) {
      parts.ranges[range.like].copies.push_back(std::move(*copy));
    } else {
      kept.push_back(i);
    }
  }
  if (kept.size() < parts.count()) keep_only(kept, parts);
}

double departure_from_parts(const Matrix& A, const IndependentParts& parts) {
  const Eigen::Index n = parts.freedoms();
  Matrix right(A.cols(), n), left(A.rows(), n);
  Matrix expected = Matrix::Zero(n, n);
  const Matrix own = congruence(parts.left, A, parts.right);
  Eigen::Index at = 0;
  const auto add = [&](const IndependentParts::Range& range, const auto& columns, const auto& rows) {
    right.middleCols(at, range.size) = columns;
    left.middleCols(at, range.size) = rows;
    expected.block(at, at, range.size, range.size) =
        own.block(range.first, range.first, range.size, range.size);
    at += range.size;
  };
  for (const IndependentParts::Range& range : parts.ranges) {
    if (range.complex_sign < 0) continue;
    add(range, parts.right.middleCols(range.first, range.size),
        parts.left.middleCols(range.first, range.size));
    for (const PartCopy& copy : range.copies) add(range, copy.right, copy.left);
  }
  const double terms = magnitudes_of_terms(left, A, right).norm();
  return terms > 0.0 ? (congruence(left, A, right) - expected).norm() / terms : 0.0;
}

}  // namespace eigentrail
