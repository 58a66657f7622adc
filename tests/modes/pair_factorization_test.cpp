// The linearized equations of a single mode, in complex and in real arithmetic, and of a block.
#include <gtest/gtest.h>

#include <cmath>

#include "modes/single_modes.hpp"
#include "support/families.hpp"

namespace eigentrail::test::pair_factorization_test {
namespace {

constexpr Eigen::Index n = 6;

ComplexVector random_vector(Eigen::Index size, std::mt19937_64& engine) {
  return random_complex(size, 1, engine);
}

struct FactoredMode {
  std::string name;
  bool damped;
  Complex s;
  Complex phase;  ///< of a real vector; zero: a vector that is not real
};

void PrintTo(const FactoredMode& mode, std::ostream* out) {
  *out << mode.name;
}

class SingleModeFactors : public testing::TestWithParam<FactoredMode> {
 protected:
  SingleModeFactors() {
    if (!GetParam().damped) family.C[0].setZero();
    const bool is_real = GetParam().phase != Complex(0.0);
    z = is_real ? ComplexVector(GetParam().phase * random_matrix(n, 1, engine).cast<Complex>())
                : random_vector(n, engine);
    z /= z.norm();
    W = ComplexMatrix::Zero(2 * n, 1);
    W.topRows(n) = z;
  }

  std::mt19937_64 engine{3};
  ReducedPencil family = random_family(n, 1);
  ComplexVector z;
  ComplexMatrix W;
};

/// P(s) dz + (2 s M + C) z ds = R, w^H dz = N for right sides that are not real in any sense.
TEST_P(SingleModeFactors, SolveTheirEquations) {
  const PencilAtPoint pencil(family);
  const Complex s = GetParam().s;
  const PairFactorization factors(pencil, z, ComplexMatrix::Constant(1, 1, s), W);
  const ComplexMatrix R = random_vector(n, engine);
  const ComplexMatrix N = ComplexMatrix::Constant(1, 1, Complex(0.3, -0.8));
  ComplexMatrix dZ, ds;
  factors.solve(R, N, dZ, ds);
  const ComplexVector slope = 2.0 * s * multiply(pencil.M, z) + multiply(pencil.C, z);
  const ComplexVector rest = pencil.matrix(s) * dZ + slope * ds(0, 0) - R;
  EXPECT_LT(rest.norm(), 1e-13 * pencil.magnitude(std::abs(s)) * dZ.norm());
  EXPECT_LT(std::abs(z.dot(dZ.col(0)) - N(0, 0)), 1e-13 * dZ.norm());
}

/// Whether <B u, v> = <u, B^H v>, and columns of a matrix give the same as vectors.
void expect_adjoint(const PairFactorization& factors, Eigen::Index size, std::mt19937_64& engine) {
  const ComplexVector u = random_vector(size, engine);
  const ComplexVector v = random_vector(size, engine);
  ComplexVector Bu = u;
  factors.solve_in_place(Bu);
  ComplexVector adjoint = v;
  factors.solve_adjoint_in_place(adjoint);
  EXPECT_LT(std::abs(Bu.dot(v) - u.dot(adjoint)), 1e-13 * Bu.norm() * v.norm() * static_cast<double>(size));
  EXPECT_GT(std::abs(Bu.dot(v)), 1e-3 * Bu.norm() * v.norm()) << "nothing compared";
  ComplexMatrix columns(size, 2);
  columns << u, u;
  factors.solve_in_place(columns);
  EXPECT_LT((columns.colwise() - Bu).norm(), 1e-11 * Bu.norm());
  columns << v, v;
  factors.solve_adjoint_in_place(columns);
  EXPECT_LT((columns.colwise() - adjoint).norm(), 1e-11 * adjoint.norm());
}

TEST_P(SingleModeFactors, HaveAnAdjoint) {
  const PencilAtPoint pencil(family);
  const PairFactorization factors(pencil, z, ComplexMatrix::Constant(1, 1, GetParam().s), W);
  expect_adjoint(factors, n + 1, engine);
}

/// Every residual of size one, one by one, against the bound of all of them.
TEST_P(SingleModeFactors, SensitivityIsThatOfTheSolutions) {
  const PencilAtPoint pencil(family);
  const PairFactorization factors(pencil, z, ComplexMatrix::Constant(1, 1, GetParam().s), W);
  ComplexMatrix dZ, ds;
  const Vector terms = Vector::LinSpaced(n, 0.1, 2.0);
  double square = 0.0, sum = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    factors.solve(ComplexVector::Unit(n, i), ComplexMatrix::Zero(1, 1), dZ, ds);
    square += std::norm(ds(0, 0));
    sum += terms[i] * std::abs(ds(0, 0));
  }
  EXPECT_NEAR(factors.sensitivity(terms).to_residual / std::sqrt(square), 1.0, tolerance);
  EXPECT_NEAR(factors.sensitivity(terms).to_terms / sum, 1.0, tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, SingleModeFactors,
    testing::Values(FactoredMode{"undamped", false, {0.0, 1.3}, 1.0},
                    FactoredMode{"undamped_with_a_phase", false, {0.0, 1.3}, std::polar(1.0, 2.1)},
                    FactoredMode{"undamped_with_a_complex_vector", false, {0.0, 1.3}, 0.0},
                    FactoredMode{"real_root", false, -0.7, 1.0},
                    FactoredMode{"damped_real_root", true, -0.7, std::polar(1.0, 0.4)},
                    FactoredMode{"damped_oscillation", true, {-0.1, 1.3}, 1.0},
                    FactoredMode{"damped_on_the_axis", true, {0.0, 1.3}, 1.0}),
    [](const auto& test) { return test.param.name; });

/// A block about which the equations are linearized need not solve them.
class BlockFactors : public testing::TestWithParam<int> {
 protected:
  int k = GetParam();
  std::mt19937_64 engine{5};
  ReducedPencil family = random_family(n, 1);
  ComplexMatrix Z = random_complex(n, k, engine);
  ComplexMatrix Lambda = random_complex(k, k, engine);
  ComplexMatrix W = random_complex(2 * n, k, engine);
};

TEST_P(BlockFactors, SolveTheirEquations) {
  const PencilAtPoint pencil(family);
  const PairFactorization factors(pencil, Z, Lambda, W);
  const ComplexMatrix R = random_complex(n, k, engine);
  const ComplexMatrix N = random_complex(k, k, engine);
  ComplexMatrix X, Y;
  factors.solve(R, N, X, Y);
  const ComplexMatrix M = pencil.M.cast<Complex>();
  const ComplexMatrix C = pencil.C.cast<Complex>();
  const ComplexMatrix rest = M * X * Lambda * Lambda + C * X * Lambda + pencil.K * X +
                             M * Z * (Lambda * Y + Y * Lambda) + C * Z * Y - R;
  const ComplexMatrix unit =
      W.topRows(n).adjoint() * X + W.bottomRows(n).adjoint() * (X * Lambda + Z * Y) - N;
  EXPECT_LT(rest.norm(), 1e-12 * (X.norm() + Y.norm()));
  EXPECT_LT(unit.norm(), 1e-12 * (X.norm() + Y.norm()));
}

TEST_P(BlockFactors, HaveAnAdjoint) {
  const PencilAtPoint pencil(family);
  expect_adjoint(PairFactorization(pencil, Z, Lambda, W), n * k + k * k, engine);
}

INSTANTIATE_TEST_SUITE_P(Sizes, BlockFactors, testing::Values(2, 3, 4));

}  // namespace
}  // namespace eigentrail::test::pair_factorization_test
