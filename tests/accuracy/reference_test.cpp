// References with 113 bits compared with closed forms that are evaluated with 113 bits.
#include "eigentrail/accuracy/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "eigentrail/modes/spectrum.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::reference_test {
namespace {

/// Closed forms and references are rounded some tens of times each, to 1e-34.
constexpr double agreement = 1e-30;

ReferenceSpectrum reference_of(const Setting& setting, double p,
                               const std::optional<ComplexVector>& followed = {}) {
  PathProblem problem = setting.problem();
  const EquilibriumGuess guess{problem.model.initial_guess(parameters_at(problem, p)), {}, false};
  return reference_spectrum(problem, p, guess, followed);
}

double distance(const ExtendedComplex& a, const ExtendedComplex& b) {
  const ExtendedComplex difference = a - b;
  return std::hypot(static_cast<double>(difference.real()), static_cast<double>(difference.imag()));
}

/// j sqrt(stiffness)
ExtendedComplex undamped(const Extended& stiffness) {
  return {Extended(0.0), sqrt(stiffness)};
}

/// Every expected eigenvalue has a reference of its own; both sorted by imaginary part.
void expect_spectrum(ReferenceSpectrum found, std::vector<ExtendedComplex> expected, double tolerance) {
  ASSERT_EQ(found.status, ReferenceStatus::converged);
  ASSERT_EQ(found.s.size(), expected.size());
  const auto by_frequency = [](const ExtendedComplex& a, const ExtendedComplex& b) {
    return a.imag() < b.imag();
  };
  std::sort(found.s.begin(), found.s.end(), by_frequency);
  std::sort(expected.begin(), expected.end(), by_frequency);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double scale = std::abs(to_double(expected[i]));
    EXPECT_LT(distance(found.s[i], expected[i]), tolerance * scale) << to_double(expected[i]);
  }
  EXPECT_LT(found.correction, agreement);
}

Setting family(const std::string& K, const std::string& C = "") {
  const std::string damping = C.empty() ? "" : "C = " + C + "\n";
  return make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[[1, 0], [0, 1]]]\n" + damping +
      "K = " + K + "\n");
}

TEST(Reference, PendulumEqualsItsClosedForm) {
  const Setting setting = scene_setting("pendulum");
  for (const double length : {0.5, 0.7, 1.5, 3.3, 5.0})
    expect_spectrum(reference_of(setting, length), {undamped(Extended(9.81) / Extended(length))}, agreement);
}

TEST(Reference, FollowsTheEquilibriumOfThePushedPendulum) {
  const Setting setting = pushed_pendulum({});
  for (const double p : {0.1, 0.5, 0.9}) {
    const Extended cosine = sqrt(Extended(1.0) - Extended(p) * Extended(p));
    expect_spectrum(reference_of(setting, p), {undamped(Extended(9.81) * cosine)}, agreement);
  }
}

TEST(Reference, SpringPendulumEqualsItsClosedForm) {
  // Height z = -m g / k at rest, so cos = m g / (k length); s^2 = -(k / m) sin^2.
  const Setting setting = scene_setting("spring_pendulum");
  for (const double k : {26.0, 20.0, 14.0}) {
    const Extended cosine = Extended(2.0) * Extended(9.81) / (Extended(k) * Extended(1.5));
    const Extended stiffness = Extended(k) / Extended(2.0) * (Extended(1.0) - cosine * cosine);
    expect_spectrum(reference_of(setting, k), {undamped(stiffness)}, agreement);
  }
}

TEST(Reference, DampedModesAndRealOnes) {
  // s^2 + s/2 + 1 + p and s^2 + 5 s + 1: a pair and two real modes.
  const Setting setting = family("[[[1, 0], [0, 1]], [[1, 0], [0, 0]]]", "[[[0.5, 0], [0, 5]]]");
  const double p = 0.3;
  const Extended decay = -0.25;
  const ExtendedComplex pair(decay, sqrt(Extended(1.0) + Extended(p) - decay * decay));
  const Extended root = sqrt(Extended(6.25) - Extended(1.0));
  ReferenceSpectrum found = reference_of(setting, p);
  ASSERT_EQ(found.s.size(), 3U);
  for (const ExtendedComplex& expected :
       {pair, ExtendedComplex(Extended(-2.5) + root), ExtendedComplex(Extended(-2.5) - root)}) {
    const bool there = std::any_of(found.s.begin(), found.s.end(), [&](const ExtendedComplex& s) {
      return distance(s, expected) < agreement * std::abs(to_double(expected));
    });
    EXPECT_TRUE(there) << to_double(expected);
  }
}

TEST(Reference, DoubleModesAreRefinedTogether) {
  const Setting setting = family("[[[3, 0], [0, 3]], [[1, 0], [0, 1]]]");
  const ExtendedComplex s = undamped(Extended(3.0) + Extended(0.3));
  expect_spectrum(reference_of(setting, 0.3), {s, s}, agreement);
}

/// Six real eigenvalues 1e-4 apart, in coordinates in which rounding makes pairs of some: none is lost.
TEST(Reference, CloseRealEigenvaluesAreAllThere) {
  constexpr int n = 6;
  std::string K = "[[", one = "[[";
  const auto entry = [](int i, int k) {  // an upper triangular matrix, eigenvalues on its diagonal
    return i == k ? 2.0 + 1e-4 * i : k > i ? 0.01 * ((3 * i + 5 * k) % 7 - 3) : 0.0;
  };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      std::ostringstream text;
      text.precision(17);
      text << (k == 0 ? "" : ", ") << entry(i, k);
      K += text.str();
      one += std::string(k == 0 ? "" : ", ") + (i == k ? "1" : "0");
    }
    K += i + 1 < n ? "], [" : "]]";
    one += i + 1 < n ? "], [" : "]]";
  }
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[" +
      std::string("[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], "
                  "[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]]\nC = [") +
      one + "]\nK = [" + K + ", " + one + "]\n");
  const ReferenceSpectrum found = reference_of(setting, 0.5);
  ASSERT_EQ(found.status, ReferenceStatus::converged);
  ASSERT_EQ(found.s.size(), 6U);
  std::vector<double> s;
  for (const ExtendedComplex& one_of_them : found.s) {
    EXPECT_LT(std::abs(to_double(one_of_them).imag()), 1e-13);
    s.push_back(-to_double(one_of_them).real());
  }
  std::sort(s.begin(), s.end());
  for (int i = 0; i < n; ++i) EXPECT_NEAR(s[static_cast<std::size_t>(i)], 2.5 + 1e-4 * i, 1e-14);
}

TEST(Reference, BesideAnExceptionalPointWhereDoublePrecisionLosesDigits) {
  // K = [[1, 1], [p, 1]]: s^2 = -(1 +- sqrt(p)).
  const Setting setting = family("[[[1, 1], [0, 1]], [[0, 0], [1, 0]]]");
  const double p = 1e-12;
  const Extended root = sqrt(Extended(p));
  const ExtendedComplex low = undamped(Extended(1.0) - root);
  expect_spectrum(reference_of(setting, p), {low, undamped(Extended(1.0) + root)}, 1e-25);

  const Matrix K = (Matrix(2, 2) << 1.0, 1.0, p, 1.0).finished();
  const Spectrum rival = compute_spectrum(Matrix::Identity(2, 2), Matrix::Zero(2, 2), K);
  double nearest = INFINITY;
  for (const StartingMode& mode : rival.modes)
    nearest = std::min(nearest, distance(ExtendedComplex(mode.s.real(), mode.s.imag()), low));
  EXPECT_GT(nearest, 1e-13);
}

TEST(Reference, SaysWhereThereIsNoEquilibrium) {
  EXPECT_EQ(reference_of(pushed_pendulum({}), 1.1).status, ReferenceStatus::no_equilibrium);
}

Parameter parameter_p() {
  Parameter p;
  p.name = "p";
  p.value = 1.0;
  return p;
}

/// A user's own model without extended precision: one mass on a spring.
class ForeignModel final : public Model {
 public:
  ForeignModel()
      : Model({.coordinate_names = {"x"},
               .coordinate_units = {"m"},
               .constraint_names = {},
               .effects = {},
               .masses = {},
               .rotation_axis = {},
               .parameters = Parameters({parameter_p()})}) {}
  Vector initial_guess(const Vector&) const override { return Vector::Zero(1); }
  Structure structure(int) const override { return {.known_equilibrium = true}; }
  EvaluationFault residual(const Path&, int order, SteadyResidual& result, EvaluationCounts&) const override {
    result = {Matrix::Zero(1, order + 1), Matrix::Zero(0, order + 1)};
    return {};
  }
  EvaluationFault linearize(const Path&, int, Linearization& result, EvaluationCounts&) const override {
    const Matrix one = Matrix::Identity(1, 1);
    result = {{one}, {Matrix::Zero(1, 1)}, {one}, {Matrix::Zero(0, 1)}};
    return {};
  }
};

TEST(Reference, RefinesThoseBesideFollowedOnesAndKeepsTheOthers) {
  // s^2 + 1 and s^2 + 6.5 + p; the first is followed, and known to a thousandth.
  const Setting setting = family("[[[1, 0], [0, 6.5]], [[0, 0], [0, 1]]]");
  ReferenceSpectrum found =
      reference_of(setting, 0.5, ComplexVector{{Complex(0.0, 1.001), Complex(NAN, NAN)}});
  ASSERT_EQ(found.s.size(), 2U);
  if (found.s[1].imag() < found.s[0].imag()) std::swap(found.s[0], found.s[1]);
  EXPECT_LT(distance(found.s[0], undamped(Extended(1.0))), agreement);
  const double other = distance(found.s[1], undamped(Extended(7.0)));
  EXPECT_LT(other, 1e-12);
  EXPECT_GT(other, agreement);  // the root of 7 is no double
}

TEST(Reference, SaysWhenAModelHasNoExtendedPrecision) {
  const ForeignModel model;
  const PathProblem problem = problem_along(model, "p");
  EXPECT_EQ(reference_spectrum(problem, 1.0, {Vector::Zero(1), {}, false}).status,
            ReferenceStatus::not_available);
}

}  // namespace
}  // namespace eigentrail::test::reference_test
