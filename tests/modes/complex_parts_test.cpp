// Complex parts: one of a conjugate pair that has real matrices [A -B; B A]. What is solved in it is the
// equation of A + iB, of half the size, also where the conjugate has the same eigenvalues.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"
#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::complex_parts_test {
namespace {

constexpr Eigen::Index m = 4;

Matrix canonical(const ComplexMatrix& A) {
  Matrix result(2 * A.rows(), 2 * A.cols());
  result << A.real(), -A.imag(), A.imag(), A.real();
  return result;
}

/// s^2 + s (0.01 K + coupling i G) + K with symmetric matrices: without coupling both whirls are the same.
struct Rotor {
  explicit Rotor(double coupling) {
    std::mt19937_64 engine(11);
    std::normal_distribution<double> normal;
    const Matrix R = Matrix::NullaryExpr(m, m, [&] { return normal(engine); });
    const Matrix S = Matrix::NullaryExpr(m, m, [&] { return normal(engine); });
    M = ComplexMatrix::Identity(m, m);
    K = (R * R.transpose() + Matrix::Identity(m, m)).cast<Complex>();
    C = 0.01 * K - Complex(0.0, coupling) * (S * S.transpose()).cast<Complex>();
  }

  ReducedPencil pencil(int complex_sign) const {
    ReducedPencil result{{canonical(M)}, {canonical(C)}, {canonical(K)}};
    result.complex_sign = complex_sign;
    return result;
  }
  std::vector<Complex> eigenvalues() const {
    ComplexMatrix A = ComplexMatrix::Zero(2 * m, 2 * m);
    A.topRightCorner(m, m).setIdentity();
    A.bottomLeftCorner(m, m) = -K;
    A.bottomRightCorner(m, m) = -C;
    const Eigen::ComplexEigenSolver<ComplexMatrix> eigen(A, false);
    return {eigen.eigenvalues().begin(), eigen.eigenvalues().end()};
  }

  ComplexMatrix M, C, K;
};

TEST(ComplexPart, CoordinatesAreThoseOfItsVectors) {
  const ComplexMatrix q = ComplexMatrix::Random(m, 3);
  const Matrix A = canonical(ComplexMatrix::Random(m, m));
  for (const int complex_sign : {1, -1}) {
    const ComplexMatrix Z = from_complex_coordinates(q, complex_sign);
    EXPECT_LT((complex_coordinates(Z, complex_sign) - q).norm(), 1e-15 * q.norm());
    EXPECT_LT(complex_coordinates(Z, -complex_sign).norm(), 1e-15 * q.norm());
    EXPECT_NEAR(Z.norm(), q.norm(), 1e-14 * q.norm());
    EXPECT_LT((A * Z - from_complex_coordinates(complex_block(A, complex_sign) * q, complex_sign)).norm(),
              1e-14 * A.norm() * q.norm());
  }
  EXPECT_EQ(canonical_form(A), A);
}

/// At rest both halves have the same eigenvalues. The equations of the whole pair are singular there, those
/// of one half are not.
TEST(ComplexPart, EquationsOfAModeAreRegularWhereBothWhirlsCoincide) {
  const Rotor rotor(0.0);
  const ReducedPencil pencil = rotor.pencil(1);
  const Spectrum spectrum = compute_spectrum(pencil);
  const StartingMode& mode = spectrum.modes[1];
  ComplexMatrix W = ComplexMatrix::Zero(4 * m, 1);
  W.topRows(2 * m) = mode.z;
  const ComplexMatrix Lambda = ComplexMatrix::Constant(1, 1, mode.s);
  const PencilAtPoint at(pencil);
  const PairFactorization factors(at, mode.z, Lambda, W);
  std::mt19937_64 engine(5);
  const ComplexMatrix R = random_complex(2 * m, 1, engine), N = random_complex(1, 1, engine);
  ComplexMatrix dZ, ds;
  factors.solve(R, N, dZ, ds);
  // The solution for what of R is in the part.
  const ComplexMatrix own = from_complex_coordinates(complex_coordinates(R, 1), 1);
  const ComplexVector slope = 2.0 * mode.s * multiply(at.M, mode.z) + multiply(at.C, mode.z);
  EXPECT_LT((at.matrix(mode.s) * dZ + slope * ds(0, 0) - own).norm(), 1e-12 * at.magnitude(std::abs(mode.s)));
  EXPECT_LT(std::abs(mode.z.dot(dZ.col(0)) - N(0, 0)), 1e-12);
  EXPECT_LT(complex_coordinates(dZ, -1).norm(), 1e-14 * dZ.norm());
  EXPECT_LT(factors.sensitivity(Vector::Ones(2 * m)).to_residual, 10.0 / slope.norm());
  // The same without its sign: the rival that must lose.
  const ReducedPencil real = rotor.pencil(0);
  const PairFactorization singular(PencilAtPoint(real), mode.z, Lambda, W);
  singular.solve(R, N, dZ, ds);
  EXPECT_FALSE(dZ.norm() < 1e10);
}

TEST(ComplexPart, BlocksAreSolvedWithTheirAdjoints) {
  const Rotor rotor(0.2);
  const ReducedPencil pencil = rotor.pencil(-1);
  const PencilAtPoint at(pencil);
  const Spectrum spectrum = compute_spectrum(pencil);
  InvariantPair pair;
  pair.Z.resize(2 * m, 2);
  pair.Z << spectrum.modes[0].z, spectrum.modes[1].z;
  pair.Lambda = ComplexVector{{spectrum.modes[0].s, spectrum.modes[1].s}}.asDiagonal();
  normalize_pair(pair.Z, pair.Lambda, pair.W, 1e-3);
  const PairFactorization factors(at, pair.Z, pair.Lambda, pair.W);
  std::mt19937_64 engine(6);
  const Eigen::Index size = 4 * m + 4;
  const ComplexVector x = random_complex(size, 1, engine), y = random_complex(size, 1, engine);
  ComplexVector Bx = x, By = y;
  factors.solve_in_place(Bx);
  factors.solve_adjoint_in_place(By);
  EXPECT_LT(std::abs(y.dot(Bx) - By.dot(x)), 1e-12 * Bx.norm() * y.norm());
  const ComplexMatrix dZ = Bx.head(4 * m).reshaped(2 * m, 2), dL = Bx.tail(4).reshaped(2, 2);
  const ComplexMatrix change = at.residual(dZ, pair.Lambda) +
                               multiply(at.M, pair.Z) * (dL * pair.Lambda + pair.Lambda * dL) +
                               multiply(at.C, pair.Z) * dL;
  const ComplexMatrix R = x.head(4 * m).reshaped(2 * m, 2);
  EXPECT_LT((change - from_complex_coordinates(complex_coordinates(R, -1), -1)).norm(), 1e-11 * R.norm());
}

}  // namespace
}  // namespace eigentrail::test::complex_parts_test
