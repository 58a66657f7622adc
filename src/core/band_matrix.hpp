// Square matrices whose entries are zero away from the diagonal, in LAPACK's band storage: column j of the
// matrix is column j of the storage, and its diagonal is a row of it. Models of beams, whose nodes are
// numbered along them, have such matrices. Products and solutions take O(n width) multiplications.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The largest |i - j| of an entry that is not zero, or `least` if that is larger. Cost: reads A once.
Eigen::Index band_width(const Matrix& A, Eigen::Index least = 0);

/// Whether products and solutions with bands of n columns are faster than with full matrices, or about as
/// fast: from 64 columns on (smaller matrices are in the fastest cache as they are), and for at most a tenth
/// of them on either side of the diagonal. It affects only the time.
constexpr bool is_narrow_band(Eigen::Index width, Eigen::Index n) {
  return n >= 64 && 10 * width <= n;
}

/// The entries within `width` of the diagonal: A(i, j) in row width + i - j, (2 width + 1) x n.
Matrix band_of(const Matrix& A, Eigen::Index width);

/// A X and A^T X, where `band` holds A.
ComplexMatrix band_product(const Matrix& band, const ComplexMatrix& X);
ComplexMatrix transposed_band_product(const Matrix& band, const ComplexMatrix& X);

/// Adds A x and A^H x to y, both of n entries.
void add_band_product(const ComplexMatrix& band, const Complex* x, Complex* y);
void add_adjoint_band_product(const ComplexMatrix& band, const Complex* x, Complex* y);

/// The factor R of A = R^T R, upper triangular, of a symmetric positive definite matrix.
class BandCholesky {
 public:
  /// The upper triangle of A is read. Cost: n width^2 / 2 multiplications.
  explicit BandCholesky(const Matrix& A);

  /// Whether A is positive definite, and not only by rounding. The maps are undefined if it is not.
  bool exists() const { return exists_; }

  Eigen::Index width() const { return factor_.rows() - 1; }
  /// R and R^-1 as full matrices. Cost of the inverse: n^3 / 6 multiplications.
  Matrix full() const;
  Matrix full_inverse() const;

  /// Overwrites x (n) with R x, R^T x, R^-1 x, R^-T x.
  void apply(Complex* x) const;
  void apply_transposed(Complex* x) const;
  void solve(Complex* x) const;
  void solve_transposed(Complex* x) const;

 private:
  Matrix factor_;  ///< (width + 1) x n: the diagonal is the last row
  bool exists_;
};

}  // namespace eigentrail
