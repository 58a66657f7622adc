// The quadratic pencil at one point of the path, in the form that the correctors use.
#pragma once

#include <memory>
#include <vector>

#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {

/// Which function of the parameter is followed: s (finite) or mu = 1/s (reciprocal). Near an infinite
/// eigenvalue (singular mass matrix) 1/s is smooth; it is an eigenvalue of the pencil with M and K exchanged.
enum class Chart { finite, reciprocal };

constexpr Chart other(Chart chart) {
  return chart == Chart::finite ? Chart::reciprocal : Chart::finite;
}

/// Number of finite eigenvalues if every coordinate without mass is of first order: n plus the number of
/// coordinates with mass, which a column of M tells. Without, but with a column in C, a coordinate is of
/// first order: its state space holds its value, and no velocity.
Eigen::Index state_size(const Matrix& M);

/// The matrix by which the highest derivatives are multiplied, n x n: the columns of `per_mass` M for
/// coordinates with mass, those of C for the others.
Matrix leading_matrix(const Matrix& M, const Matrix& C, double per_mass = 1.0);

/// M, C and K, n x n, of which the entries further than `width` from the diagonal are zero: A(i, j) in row
/// width + i - j and column j, (2 width + 1) x n. Null where they are not known to be banded. Copies share
/// them.
struct PencilBands {
  std::shared_ptr<const Matrix> M, C, K;

  explicit operator bool() const { return M != nullptr; }
  /// a M + b C + c K in the same storage.
  ComplexMatrix sum(Complex a, Complex b, double c) const;
};

/// mu^2 M + mu C + K at one point, with M and K exchanged in the reciprocal chart; mu is s or 1/s.
struct PencilAtPoint {
  const Matrix& M;
  const Matrix& C;
  const Matrix& K;
  double norm_M, norm_C, norm_K;  ///< Frobenius norms
  int complex_sign;               ///< of a complex part (complex_blocks.hpp); else 0
  PencilBands bands = {};         ///< the same matrices: products with them and factors take less time

  explicit PencilAtPoint(const ReducedPencil& pencil, Chart chart = Chart::finite);
  /// The pencil is referenced, not copied.
  explicit PencilAtPoint(ReducedPencil&&, Chart = Chart::finite) = delete;
  /// The same pencil in the given chart, from its form in the finite chart.
  PencilAtPoint(const PencilAtPoint& finite, Chart chart);

  Eigen::Index size() const { return M.rows(); }
  bool is_undamped() const { return norm_C == 0.0; }  ///< whether C is zero
  ComplexMatrix matrix(Complex mu) const;
  /// M Z Lambda^2 + C Z Lambda + K Z.
  ComplexMatrix residual(const ComplexMatrix& Z, const ComplexMatrix& Lambda) const;
  /// Magnitudes of the terms that the rows of the residual are sums of, n: the norms of the rows of
  /// |M| |Z| |Lambda|^2 + |C| |Z| |Lambda| + |K| |Z|, with magnitudes entry by entry. Rounding of every entry
  /// of the matrices by a share of it changes the residual by at most that share of them.
  Vector terms(const ComplexMatrix& Z, const ComplexMatrix& Lambda) const;
  /// |mu|^2 |M| + |mu| |C| + |K|, the scale of backward errors; `mu` is the magnitude of the eigenvalue.
  double magnitude(double mu) const;
};

/// B Z for a real matrix B and few complex columns.
ComplexMatrix multiply(const Matrix& B, const ComplexMatrix& Z);
ComplexMatrix multiply(const SparseMatrix& B, const ComplexMatrix& Z);
ComplexMatrix multiply(const SystemMatrix& B, const ComplexMatrix& Z);
/// B^T Z.
ComplexMatrix transposed_multiply(const Matrix& B, const ComplexMatrix& Z);
/// The same by the band of B, unless that is null.
ComplexMatrix multiply(const Matrix& B, const std::shared_ptr<const Matrix>& band, const ComplexMatrix& Z);
ComplexMatrix transposed_multiply(const Matrix& B, const std::shared_ptr<const Matrix>& band,
                                  const ComplexMatrix& Z);

}  // namespace eigentrail
