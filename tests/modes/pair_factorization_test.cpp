// The linearized equations of a single mode, in complex and in real arithmetic.
#include <gtest/gtest.h>

#include <cmath>

#include "modes/single_modes.hpp"
#include "support/families.hpp"

namespace eigentrail::test {
namespace {

constexpr Eigen::Index n = 6;

ComplexVector random_vector(std::mt19937_64& engine) {
  ComplexVector v(n);
  v.real() = random_matrix(n, 1, engine);
  v.imag() = random_matrix(n, 1, engine);
  return v;
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
                : random_vector(engine);
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
  const ComplexMatrix R = random_vector(engine);
  const ComplexMatrix N = ComplexMatrix::Constant(1, 1, Complex(0.3, -0.8));
  ComplexMatrix dZ, ds;
  factors.solve(R, N, dZ, ds);
  const ComplexVector slope = 2.0 * s * multiply(pencil.M, z) + multiply(pencil.C, z);
  const ComplexVector rest = pencil.matrix(s) * dZ + slope * ds(0, 0) - R;
  EXPECT_LT(rest.norm(), 1e-13 * pencil.magnitude(std::abs(s)) * dZ.norm());
  EXPECT_LT(std::abs(z.dot(dZ.col(0)) - N(0, 0)), 1e-13 * dZ.norm());
}

/// Every residual of size one, one by one, against the bound of all of them.
TEST_P(SingleModeFactors, SensitivityIsThatOfTheSolutions) {
  const PencilAtPoint pencil(family);
  const PairFactorization factors(pencil, z, ComplexMatrix::Constant(1, 1, GetParam().s), W);
  ComplexMatrix dZ, ds;
  double square = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    factors.solve(ComplexVector::Unit(n, i), ComplexMatrix::Zero(1, 1), dZ, ds);
    square += std::norm(ds(0, 0));
  }
  EXPECT_NEAR(factors.sensitivity() / std::sqrt(square), 1.0, tolerance);
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

}  // namespace
}  // namespace eigentrail::test
