#include "reduction/free_motions.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

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

}  // namespace

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

}  // namespace eigentrail
