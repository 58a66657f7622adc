#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/products.hpp"
#include "core/reciprocal_condition.hpp"
#include "core/thin_product.hpp"
#include "eigentrail/modes/all_pairs.hpp"
#include "modes/companion_form.hpp"

namespace eigentrail {
namespace {

constexpr double least_rcond = 1e-9;  ///< smallest accepted reciprocal condition of M and of the modal basis

/// The inverse of a matrix; empty if it is ill-conditioned. Many leading matrices are diagonal.
std::optional<Matrix> inverse_of(const Matrix& A) {
  if (A.isDiagonal(0.0)) {
    const Vector magnitudes = A.diagonal().cwiseAbs();
    if (!(magnitudes.minCoeff() > least_rcond * magnitudes.maxCoeff())) return std::nullopt;
    return Matrix(A.diagonal().cwiseInverse().asDiagonal());
  }
  const Eigen::PartialPivLU<Matrix> lu(A);
  if (!(reciprocal_condition(lu) > least_rcond)) return std::nullopt;
  return lu.inverse();
}

/// The inverse of the leading matrix of a pencil; empty if it is ill-conditioned with its columns of M scaled
/// like velocities, by the frequency gamma.
std::optional<Matrix> inverse_of_leading(const PencilAtPoint& pencil,
                                         const std::vector<Eigen::Index>& with_mass, double gamma) {
  const bool all_have_mass = static_cast<Eigen::Index>(with_mass.size()) == pencil.size();
  const double per_mass = all_have_mass ? 1.0 : gamma;
  std::optional<Matrix> inverse = inverse_of(leading_matrix(pencil.M, pencil.C, per_mass));
  if (inverse && !all_have_mass) (*inverse)(with_mass, Eigen::all) *= per_mass;
  return inverse;
}

}  // namespace

ComplexMatrix inverse_sylvester(const ComplexMatrix& D, const ComplexMatrix& L) {
  const Eigen::Index m = D.rows();
  const Eigen::Index k = L.rows();
  ComplexMatrix system = ComplexMatrix::Zero(m * k, m * k);
  for (Eigen::Index j = 0; j < k; ++j) {
    system.block(j * m, j * m, m, m) = -D;
    for (Eigen::Index i = 0; i < k; ++i) system.block(j * m, i * m, m, m).diagonal().array() += L(i, j);
  }
  return system.partialPivLu().inverse();
}

ComplexMatrix multiply_many(const Matrix& B, const ComplexMatrix& Z) {
  if (B.isDiagonal(0.0)) return B.diagonal().asDiagonal() * Z;
  const Eigen::Index m = Z.cols();
  Matrix parts(Z.rows(), 2 * m);
  parts.leftCols(m) = Z.real();
  parts.rightCols(m) = Z.imag();
  const Matrix both = product(B, parts);
  ComplexMatrix result(B.rows(), m);
  result.real() = both.leftCols(m);
  result.imag() = both.rightCols(m);
  return result;
}

std::optional<ModalBasis> ModalBasis::from(const PencilAtPoint& pencil, const PairSet& pairs,
                                           std::optional<Matrix>& leading_inverse) {
  const Eigen::Index n = pencil.size();
  const Eigen::Index columns = pairs.Z.cols();
  ModalBasis basis;
  basis.conjugate_.assign(static_cast<std::size_t>(columns), -1);
  basis.real_row_.assign(static_cast<std::size_t>(columns), 0);
  Eigen::Index rows = columns;
  for (const PairSet::Place& place : pairs.places) {
    if (place.is_real) continue;
    for (Eigen::Index i = 0; i < place.size; ++i)
      basis.conjugate_[static_cast<std::size_t>(place.first + i)] = rows++;
  }
  // coordinates whose velocities are states, too
  const std::vector<Eigen::Index> velocities = coordinates_with_mass(pencil.M);
  if (rows != n + static_cast<Eigen::Index>(velocities.size())) return std::nullopt;

  double gamma = 0.0;
  for (const PairSet::Place& place : pairs.places)
    gamma = std::max(gamma, pairs.block(pairs.Lambda, place).norm());
  if (!(gamma > 0.0) || !std::isfinite(gamma)) return std::nullopt;
  Matrix V(rows, rows);
  Eigen::Index row = 0;
  basis.s_.assign(static_cast<std::size_t>(rows), std::numeric_limits<double>::quiet_NaN());
  for (const PairSet::Place& place : pairs.places) {
    const auto Z = pairs.Z.middleCols(place.first, place.size);
    ComplexMatrix ZL(0, place.size);
    if (!velocities.empty())
      ZL = (thin_product(Z, pairs.block(pairs.Lambda, place)) / gamma)(velocities, Eigen::all);
    for (Eigen::Index i = 0; i < place.size; ++i) {
      const auto column = static_cast<std::size_t>(place.first + i);
      basis.real_row_[column] = row;
      V.col(row) << Z.col(i).real(), ZL.col(i).real();
      ++row;
      if (place.is_real) continue;
      V.col(row) << Z.col(i).imag(), ZL.col(i).imag();
      ++row;
    }
    if (place.size > 1) continue;
    const auto column = static_cast<std::size_t>(place.first);
    basis.s_[column] = pairs.Lambda(0, place.first);
    if (!place.is_real)
      basis.s_[static_cast<std::size_t>(basis.conjugate_[column])] = std::conj(basis.s_[column]);
  }
  if (!leading_inverse) leading_inverse = inverse_of_leading(pencil, velocities, gamma);
  const Eigen::PartialPivLU<Matrix> lu(V);
  const double rcond = reciprocal_condition(lu);
  if (!(rcond > least_rcond) || !leading_inverse) return std::nullopt;
  basis.rounding_ = 10.0 * std::numeric_limits<double>::epsilon() / rcond;
  // A force changes the velocities of coordinates with mass, and the values of the others.
  Matrix load(rows, n);
  load << *leading_inverse, (*leading_inverse)(velocities, Eigen::all) / gamma;
  load(velocities, Eigen::all).setZero();
  basis.left_ = lu.solve(load);
  basis.right_ = V.topRows(n);
  return basis;
}

ComplexMatrix ModalBasis::coordinates(const ComplexMatrix& R) const {
  const ComplexMatrix g = multiply_many(left_, R);
  ComplexMatrix G(g.rows(), g.cols());
  for (std::size_t i = 0; i < real_row_.size(); ++i) {
    const Eigen::Index row = real_row_[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (conjugate_[i] < 0) {
      G.row(column) = g.row(row);
      continue;
    }
    // Coordinates of z and its conjugate from those of Re z and Im z.
    G.row(column) = 0.5 * (g.row(row) - Complex(0.0, 1.0) * g.row(row + 1));
    G.row(conjugate_[i]) = 0.5 * (g.row(row) + Complex(0.0, 1.0) * g.row(row + 1));
  }
  return G;
}

ComplexMatrix ModalBasis::vectors(const ComplexMatrix& U) const {
  ComplexMatrix u(U.rows(), U.cols());
  for (std::size_t i = 0; i < real_row_.size(); ++i) {
    const Eigen::Index row = real_row_[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (conjugate_[i] < 0) {
      u.row(row) = U.row(column);
      continue;
    }
    u.row(row) = U.row(column) + U.row(conjugate_[i]);
    u.row(row + 1) = Complex(0.0, 1.0) * (U.row(column) - U.row(conjugate_[i]));
  }
  return multiply_many(right_, u);
}

void ModalBasis::prepare_division(const PairSet& pairs) {
  const Eigen::Index rows = left_.rows();
  divisors_ = ComplexMatrix::Zero(rows, pairs.Z.cols());
  for (Eigen::Index b = 0; b < divisors_.cols(); ++b) {
    for (Eigen::Index a = 0; a < rows; ++a) {
      const Complex difference = s_[static_cast<std::size_t>(b)] - s_[static_cast<std::size_t>(a)];
      const bool is_number = !std::isnan(difference.real()) && !std::isnan(difference.imag());
      if (a != b && is_number) divisors_(a, b) = 1.0 / difference;
    }
  }
  for (const PairSet::Place& b : pairs.places) {
    for (const PairSet::Place& a : pairs.places) {
      if (a.size == 1 && b.size == 1) continue;
      const ComplexMatrix D = pairs.block(pairs.Lambda, a);
      const ComplexMatrix L = pairs.block(pairs.Lambda, b);
      if (a.first != b.first)
        divisions_.push_back({a.first, b.first, a.size, b.size, inverse_sylvester(D, L)});
      if (!a.is_real) {
        divisions_.push_back(
            {conjugate_row(a.first), b.first, a.size, b.size, inverse_sylvester(D.conjugate(), L)});
      }
    }
  }
}

/// Divides G by the differences of the eigenvalues: G becomes U.
void ModalBasis::divide(ComplexMatrix& G) const {
  const ComplexMatrix beside_blocks = divisions_.empty() ? ComplexMatrix() : G;
  G = G.cwiseProduct(divisors_);
  ComplexVector x, y;
  for (const auto& [row, column, rows, columns, inverse] : divisions_) {
    x = beside_blocks.block(row, column, rows, columns).reshaped();
    y.noalias() = inverse * x;
    G.block(row, column, rows, columns) = y.reshaped(rows, columns);
  }
}

void ModalBasis::solve(const PairSet& pairs, const ComplexMatrix& R, const ComplexMatrix& N,
                       ComplexMatrix& dZ, ComplexMatrix& dLambda) const {
  const Eigen::Index n = R.rows();
  ComplexMatrix G = coordinates(R);
  dLambda = ComplexMatrix::Zero(N.rows(), N.cols());
  for (const PairSet::Place& place : pairs.places) {
    dLambda.block(0, place.first, place.size, place.size) =
        G.block(place.first, place.first, place.size, place.size);
  }
  divide(G);
  dZ = vectors(G);
  // The division leaves the part of dZ within the space of each pair open: a change of its basis. The
  // normalization determines it.
  for (const PairSet::Place& place : pairs.places) {
    auto X = dZ.middleCols(place.first, place.size);
    const auto Z = pairs.Z.middleCols(place.first, place.size);
    const auto W = pairs.W.middleCols(place.first, place.size);
    auto dL = dLambda.block(0, place.first, place.size, place.size);
    if (place.size == 1) {
      X += Z * (N(0, place.first) - W.col(0).head(n).dot(X.col(0)));
      continue;
    }
    const ComplexMatrix L = pairs.block(pairs.Lambda, place);
    const ComplexMatrix XL = thin_product(X, L) + thin_product(Z, dL);
    const ComplexMatrix S = pairs.block(N, place) - thin_product(W.topRows(n).adjoint(), X) -
                            thin_product(W.bottomRows(n).adjoint(), XL);
    X += thin_product(Z, S);
    dL += L * S - S * L;
  }
}

PairSensitivity ModalBasis::sensitivity(const PairSet::Place& place, const Vector& terms) const {
  PairSensitivity squares;
  for (Eigen::Index i = 0; i < place.size; ++i) {
    const Eigen::Index first = real_row_[static_cast<std::size_t>(place.first + i)];
    Vector row = left_.row(first).cwiseAbs();
    if (!place.is_real)
      row = 0.5 * (row.cwiseAbs2() + left_.row(first + 1).transpose().cwiseAbs2()).cwiseSqrt();
    squares.to_residual += row.squaredNorm();
    squares.to_terms += std::pow(row.dot(terms), 2);
  }
  return {std::sqrt(squares.to_residual), std::sqrt(squares.to_terms)};
}

}  // namespace eigentrail
