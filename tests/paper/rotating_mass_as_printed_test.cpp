// The numbers printed in Sect. 6.3.2 of the seed paper, Eqs. (161) to (166). They come out only with three
// changes to the paper's own equations, made together:
//   1. r = 20, where Table 1 says 2;
//   2. a Coriolis term m omega, where (144) has 2 m omega;
//   3. an equilibrium with the centrifugal force acting on z as well; the eigenproblem has diag(1, 1, 0).
// (167) is not reproduced by any reading and is not tested.
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "paper/rotating_mass_reference.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::rotating_mass_as_printed_test {
namespace {

constexpr double m = 50.0, r = 20.0, length = 5.0, e = 1.0, omega = 40.0, a_t = -100.0, a_n = 1000.0;

/// Order 0 is all that is printed.
class AsPrinted final : public Model {
 public:
  /// `centrifugal_on_z`: 1 for the equilibrium, 0 for the eigenproblem.
  explicit AsPrinted(double centrifugal_on_z)
      : Model({{"x", "y", "z"}, {"m", "m", "m"}, {"hinge"}, {}, {}, {}, {}, {}}),
        centrifugal_on_z_(centrifugal_on_z) {}

  Vector initial_guess(const Vector&) const override { return Vector{{length, 0.0, 0.0}}; }
  Structure structure(int) const override { return {}; }

  EvaluationFault residual(const Path& path, int, SteadyResidual& result, EvaluationCounts&) const override {
    const Vector x = path.x.col(0);
    result.force = 2.0 * path.lambda(0, 0) * x + stiffness() * x - Vector{{m * omega * omega * e, 0.0, 0.0}};
    result.constraint = Matrix::Constant(1, 1, x.squaredNorm() - length * length);
    return {};
  }

  EvaluationFault linearize(const Path& path, int, Linearization& result, EvaluationCounts&) const override {
    const Matrix I = Matrix::Identity(3, 3);
    result.M = {m * I};
    result.C = {m * omega * Matrix{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}} + r * I};
    result.K = {stiffness() + 2.0 * path.lambda(0, 0) * I};
    result.A = {2.0 * path.x.col(0).transpose()};
    return {};
  }

 private:
  Matrix stiffness() const {
    const Matrix plane = Vector{{1.0, 1.0, centrifugal_on_z_}}.asDiagonal();
    return -m * omega * omega * plane + Matrix{{0.0, a_t, a_n}, {-a_t, 0.0, 0.0}, {-a_n, 0.0, 0.0}};
  }

  double centrifugal_on_z_;
};

/// A number as printed: equal to all `digits` digits after the point of the mantissa given.
testing::AssertionResult printed(double value, double shown, double last_digit) {
  if (std::abs(value - shown) <= 0.5001 * last_digit) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value << " does not round to " << shown;
}
testing::AssertionResult printed(Complex value, Complex shown, double last_real, double last_imag) {
  const auto real = printed(value.real(), shown.real(), last_real);
  return real ? printed(value.imag(), shown.imag(), last_imag) : real;
}

class PaperAsPrinted : public testing::Test {
 protected:
  void SetUp() override {
    const AsPrinted model(1.0);
    EvaluationCounts counts;
    equilibrium = solve_equilibrium(model, Vector(), model.initial_guess(Vector()), Vector(), {}, counts);
    ASSERT_EQ(equilibrium.status, SteadyStatus::converged);
    const AsPrinted eigenproblem(0.0);
    ASSERT_FALSE(
        eigenproblem.linearize({Vector(), equilibrium.x, equilibrium.lambda}, 0, linearization, counts));
    // Matlab's qr() of a column is one Householder reflection, with R1 = -|A|.
    const Vector a = equilibrium.x / length;
    Vector v = a;
    v[0] += 1.0;
    const Matrix H = Matrix::Identity(3, 3) - (2.0 / v.squaredNorm()) * v * v.transpose();
    Q1 = H.col(0);
    basis = {{H.rightCols(2)}, false};
    pencil = reduce(linearization, basis, 0);
    spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
    ASSERT_EQ(spectrum.modes.size(), 2U);
  }

  /// Physical vector with its largest component made one.
  ComplexVector shape(std::size_t i) const {
    const ComplexVector v = basis.T[0].cast<Complex>() * spectrum.modes[i].z;
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    return v / v[largest];
  }

  Equilibrium equilibrium;
  Linearization linearization;
  Vector Q1;
  TangentBasis basis;
  ReducedPencil pencil;
  Spectrum spectrum;
};

TEST_F(PaperAsPrinted, EquilibriumOf161) {
  const Vector& x = equilibrium.x;
  EXPECT_TRUE(printed(x[0], 4.9901, 1e-4));
  EXPECT_TRUE(printed(x[1], -0.0313, 1e-4));
  EXPECT_TRUE(printed(x[2], 0.3125, 1e-4));
  EXPECT_TRUE(printed(equilibrium.lambda[0], 4.7984e4, 1.0));
  EXPECT_TRUE(printed(linearization.A[0](0, 0), 9.9803, 1e-4));
  EXPECT_TRUE(printed(linearization.A[0](0, 1), -0.0625, 1e-4));
  EXPECT_TRUE(printed(linearization.A[0](0, 2), 0.6250, 1e-4));
}

TEST_F(PaperAsPrinted, FactorizationOf163) {
  EXPECT_TRUE(printed(Q1[0], -9.9803e-1, 1e-5));
  EXPECT_TRUE(printed(Q1[1], 6.2500e-3, 1e-7));
  EXPECT_TRUE(printed(Q1[2], -6.2500e-2, 1e-6));
  const Matrix& Q2 = basis.T[0];
  EXPECT_TRUE(printed(Q2(0, 0), 6.2500e-3, 1e-7));
  EXPECT_TRUE(printed(Q2(0, 1), -6.2500e-2, 1e-6));
  EXPECT_TRUE(printed(Q2(1, 0), 9.9998e-1, 1e-5));
  EXPECT_TRUE(printed(Q2(1, 1), 1.9551e-4, 1e-8));
  EXPECT_TRUE(printed(Q2(2, 0), 1.9551e-4, 1e-8));
  EXPECT_TRUE(printed(Q2(2, 1), 9.9804e-1, 1e-5));
}

TEST_F(PaperAsPrinted, ProjectedMatricesOf164) {
  EXPECT_LT((pencil.M[0] - 50.0 * Matrix::Identity(2, 2)).norm(), 1e-12 * m);
  EXPECT_TRUE(printed(pencil.C[0](0, 0), 20.0, 1.0));
  EXPECT_TRUE(printed(pencil.C[0](0, 1), -125.0, 1.0));
  EXPECT_TRUE(printed(pencil.C[0](1, 0), 125.0, 1.0));
  EXPECT_TRUE(printed(pencil.K[0](0, 0), 1.5968e4, 1.0));
  EXPECT_TRUE(printed(pencil.K[0](0, 1), 0.0016e4, 1.0));
  EXPECT_TRUE(printed(pencil.K[0](1, 0), 0.0016e4, 1.0));
  EXPECT_TRUE(printed(pencil.K[0](1, 1), 9.5656e4, 1.0));
}

TEST_F(PaperAsPrinted, EigenvaluesOf162And165) {
  EXPECT_TRUE(printed(spectrum.modes[0].s, {-0.1992, 17.8349}, 1e-4, 1e-4));
  EXPECT_TRUE(printed(spectrum.modes[1].s, {-0.2008, 43.8244}, 1e-4, 1e-4));
}

TEST_F(PaperAsPrinted, EigenvaluesAgreeWithHighPrecisionOfTheSameEquations) {
  for (std::size_t i = 0; i < 2; ++i) {
    const Complex expected = rotating_mass_as_printed[i].derivative(0);
    EXPECT_LT(std::abs(spectrum.modes[i].s - expected), 1e-12 * std::abs(expected));
  }
}

TEST_F(PaperAsPrinted, PhysicalVectorsOf166) {
  const ComplexVector lag = shape(0);
  EXPECT_TRUE(printed(lag[0], {6.2429e-3, 1.7472e-3}, 1e-7, 1e-7));
  EXPECT_TRUE(printed(lag[2], {3.1147e-4, -2.7900e-2}, 1e-8, 1e-6));
  const ComplexVector flap = shape(1);
  EXPECT_TRUE(printed(flap[0], {-6.2619e-2, -4.2932e-4}, 1e-6, 1e-8));
  EXPECT_TRUE(printed(flap[1], {7.0331e-4, -6.8555e-2}, 1e-8, 1e-6));
}

TEST_F(PaperAsPrinted, ReducedVectorsOf165AreNormalizedInStateSpace) {
  // |z|^2 (1 + |s|^2) = 1; the phase is Matlab's, recovered from the first component. In (165b) the exponent
  // of the first imaginary part is e-3, and the sign of the second component is the opposite: misprints.
  const auto normalized = [&](std::size_t i, Complex first) {
    const StartingMode& mode = spectrum.modes[i];
    ComplexVector z = mode.z / (mode.z.norm() * std::sqrt(1.0 + std::norm(mode.s)));
    return ComplexVector(z * (first / std::abs(first)) * (std::abs(z[0]) / z[0]));
  };
  const ComplexVector lag = normalized(0, {-6.2501e-4, -5.5953e-2});
  EXPECT_TRUE(printed(std::abs(lag[0]), std::abs(Complex(-6.2501e-4, -5.5953e-2)), 1e-6));
  EXPECT_TRUE(printed(lag[1], {-1.5642e-3, 1.0979e-5}, 1e-7, 2e-8));
  const ComplexVector flap = normalized(1, {1.5573e-3, 4.3708e-6});
  EXPECT_TRUE(printed(std::abs(flap[0]), std::abs(Complex(1.5573e-3, 4.3708e-6)), 1e-7));
  EXPECT_TRUE(printed(std::abs(flap[1]), std::abs(Complex(1.0427e-4, 2.2759e-2)), 1e-6));
}

TEST_F(PaperAsPrinted, DaeVectorsOf162) {
  // (30) with the multiplier: A^T dlambda = -P v. The printed vectors are compared relative to their largest
  // component, which fixes length and phase.
  const Complex shown_lag[] = {
      {4.6758e-7, -1.7458e-6}, {-3.1218e-6, -2.7877e-4}, {-7.7786e-6, 0.0}, {9.9719e-1, -2.8105e-3}};
  const Complex shown_flap[] = {
      {3.3108e-6, -1.4288e-3}, {1.5643e-3, 8.9478e-6}, {1.0356e-4, 2.2817e-2}, {-1.0918e-1, -1.0703e-2}};
  for (const auto& [i, shown] :
       {std::pair(std::size_t{0}, shown_lag), std::pair(std::size_t{1}, shown_flap)}) {
    const Complex s = spectrum.modes[i].s;
    const ComplexVector v = basis.T[0].cast<Complex>() * spectrum.modes[i].z;
    const ComplexVector force =
        -(s * s * (linearization.M[0] * v) + s * (linearization.C[0] * v) + linearization.K[0] * v);
    ComplexVector y(4);
    const Vector row = linearization.A[0].dense().row(0);
    y << v, row.cast<Complex>().dot(force) / row.squaredNorm();
    const Complex scale = shown[3] / y[3];
    for (Eigen::Index c = 0; c < 3; ++c) {
      // Five printed digits of the scaling component limit what the others can show.
      EXPECT_LT(std::abs(y[c] * scale - shown[c]), 1e-4 * std::abs(shown[c]))
          << "mode " << i << " component " << c;
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::rotating_mass_as_printed_test
