#include "bench/shift_invert.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace eigentrail::test {
namespace {

/// (A - shift E)^-1 E of the companion pencil A = [0 I; -K -C], E = [I 0; 0 M] by one LU of size n.
class InvertedCompanion {
 public:
  InvertedCompanion(const Matrix& M, const Matrix& C, const Matrix& K, Complex shift)
      : M_(M.cast<Complex>()),
        slope_(C.cast<Complex>() + shift * M_),
        shift_(shift),
        lu_(K.cast<Complex>() + shift * slope_) {}

  Eigen::Index size() const { return 2 * M_.rows(); }

  ComplexVector operator()(const ComplexVector& x) const {
    const Eigen::Index n = M_.rows();
    ComplexVector y(2 * n);
    y.head(n) = lu_.solve(-(M_ * x.tail(n) + slope_ * x.head(n)));
    y.tail(n) = x.head(n) + shift_ * y.head(n);
    return y;
  }

 private:
  ComplexMatrix M_, slope_;
  Complex shift_;
  Eigen::PartialPivLU<ComplexMatrix> lu_;
};

/// Upper Hessenberg matrix of `steps` Arnoldi steps; smaller where the space is invariant before.
ComplexMatrix arnoldi(const InvertedCompanion& apply, int steps) {
  ComplexMatrix Q(apply.size(), steps + 1);
  ComplexMatrix H = ComplexMatrix::Zero(steps + 1, steps);
  Q.col(0).setConstant(1.0);
  Q.col(0).normalize();
  for (Eigen::Index j = 0; j < steps; ++j) {
    ComplexVector w = apply(Q.col(j));
    const auto basis = Q.leftCols(j + 1);
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough
      const ComplexVector overlap = basis.adjoint() * w;
      w -= basis * overlap;
      H.col(j).head(j + 1) += overlap;
    }
    const double rest = w.norm();
    if (!(rest > 1e-14 * H.col(j).norm())) return H.topLeftCorner(j + 1, j + 1);
    H(j + 1, j) = rest;
    Q.col(j + 1) = w / rest;
  }
  return H.topRows(steps);
}

}  // namespace

ComplexVector eigenvalues_near(const Matrix& M, const Matrix& C, const Matrix& K, Complex shift, int steps) {
  const InvertedCompanion apply(M, C, K, shift);
  const auto most = static_cast<int>(std::min<Eigen::Index>(steps, apply.size()));
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(arnoldi(apply, most), false);
  ComplexVector theta = solver.eigenvalues();
  std::sort(theta.begin(), theta.end(), [](Complex a, Complex b) { return std::abs(a) > std::abs(b); });
  return (shift + theta.cwiseInverse().array()).matrix();
}

}  // namespace eigentrail::test
