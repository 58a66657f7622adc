// Whole traces through spectra that are hard in themselves: exceptional points of a high order, non-normal
// pencils, zeros, eigenvalues from infinity, narrow bumps, poles of the equilibrium. All are known in closed
// form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "support/scenes.hpp"

namespace eigentrail::test::sensitive_spectra_test {
namespace {

/// A matrix in the words of a scene, from a function of row and column.
template <class Entry>
std::string matrix(int n, Entry entry) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < n; ++i) {
    text << (i == 0 ? "[[" : ", [");
    for (int k = 0; k < n; ++k) text << (k == 0 ? "" : ", ") << entry(i, k);
    text << "]";
  }
  return text.str() + "]";
}

Setting family(int n, const std::string& M, const std::string& C, const std::string& K, double from,
               double to, double tolerance) {
  std::ostringstream text;
  text << "[trace]\nparameter = \"p\"\nfrom = " << from << "\nto = " << to << "\ntolerance = " << tolerance
       << "\n[matrix_family]\nM = [" << M << "]\nC = ["
       << (C.empty() ? matrix(n, [](int, int) { return 0; }) : C) << "]\nK = [" << K << "]\n";
  return make_setting(text.str());
}

std::string identity(int n) {
  return matrix(n, [](int i, int k) { return i == k ? 1 : 0; });
}
std::string zero(int n) {
  return matrix(n, [](int, int) { return 0; });
}

/// x' = A(p) x with A = tridiag(1 + p, -2, 1 - p), the difference equations of flow with diffusion: s = -2 +
/// 2 sqrt(1 - p^2) cos(k pi / (n + 1)). All n are real below p = 1, meet there in one exceptional point with
/// one eigenvector, and are complex above. Long before it their vectors are parallel to rounding, and the
/// matrix of a block of them tells them only to the n-th root of rounding.
struct Flow {
  int n;
  double tolerance;
  bool forward;
};

class FlowWithDiffusion : public testing::TestWithParam<Flow> {
 protected:
  static RecordedTrace trace(const Flow& flow) {
    const int n = flow.n;
    const auto band = [n](double below, double on, double above) {
      return matrix(n, [=](int i, int k) {
        return i == k ? on : k == i - 1 ? below : k == i + 1 ? above : 0.0;
      });
    };
    return record_trace(family(n, zero(n), identity(n), band(-1, 2, -1) + ", " + band(-1, 0, 1),
                               flow.forward ? 0.0 : 3.0, flow.forward ? 3.0 : 0.0, flow.tolerance));
  }
  /// Those with Im s >= 0, by ascending distance from -2: one of every pair, or all that are real.
  static std::vector<Complex> exact(int n, double p) {
    std::vector<Complex> all;
    for (int k = 1; k <= n; ++k) {
      const Complex s = -2.0 + 2.0 * std::sqrt(Complex(1.0 - p * p)) * std::cos(k * M_PI / (n + 1));
      if (s.imag() >= -1e-12) all.push_back(s);
    }
    return all;
  }
};

TEST_P(FlowWithDiffusion, IsFollowedThroughItsExceptionalPointWhereAllItsModesCollideOnce) {
  const int n = GetParam().n;
  const RecordedTrace trace = FlowWithDiffusion::trace(GetParam());
  ASSERT_EQ(trace.result.status, TraceStatus::completed) << trace.result.message;
  EXPECT_LT(trace.result.nodes, 100);
  for (const std::string& note : trace.result.notes) ADD_FAILURE() << note;
  for (const double p : {0.0, 0.5, 0.9, 1.5, 2.9}) {
    std::vector<Complex> found;
    for (const Complex s : trace.eigenvalues_at(p)) {
      if (std::isfinite(s.real())) found.push_back(s);
    }
    const std::vector<Complex> expected = exact(n, p);
    ASSERT_EQ(found.size(), expected.size()) << p;
    for (const Complex s : expected) {
      double nearest = INFINITY;
      for (const Complex other : found) nearest = std::min(nearest, std::abs(other - s));
      EXPECT_LT(nearest, 2.0 * GetParam().tolerance * std::abs(s)) << p << " " << s;
    }
  }
  const Event event = only_event(trace.result, EventKind::collision);
  EXPECT_NEAR(event.p, 1.0, 1e-10);
  EXPECT_LT(std::abs(event.s + 2.0), 1e-10);
  EXPECT_EQ(event.modes.size(), static_cast<std::size_t>(n));
  // Their mean square, 4 (1 - p^2) sum cos^2 / n = 2 (1 - p^2) (n - 1) / n, has the slope -4 (n - 1) / n.
  EXPECT_NEAR(std::abs(event.puiseux), 2.0 * std::sqrt((n - 1.0) / n), 1e-3);
}

std::vector<Flow> flows() {
  std::vector<Flow> all;
  for (const int n : {3, 4, 5, 6, 7, 8, 10, 12}) {
    for (const double tolerance : {1e-6, 1e-9}) {
      for (const bool forward : {true, false}) all.push_back({n, tolerance, forward});
    }
  }
  all.push_back({16, 1e-6, false});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, FlowWithDiffusion, testing::ValuesIn(flows()), [](const auto& one) {
  return std::to_string(one.param.n) + (one.param.tolerance < 1e-7 ? "_fine_" : "_") +
         (one.param.forward ? "forward" : "backward");
});

/// (s + 2 (1 + p))^2: two eigenvalues that are one, with one vector, on the whole range. Rounding splits them
/// by its root, into a pair at one point and into two at the next.
TEST(SensitiveSpectra, TwoThatAreOneEverywhereStayTwoRealModes) {
  for (const bool forward : {true, false}) {
    const RecordedTrace trace = completed_trace(family(1, "[[1]]", "[[4]], [[4]]", "[[4]], [[8]], [[4]]",
                                                       forward ? 0.0 : 1.0, forward ? 1.0 : 0.0, 1e-9));
    EXPECT_EQ(trace.result.certified_steps, trace.result.mode_steps);
    EXPECT_TRUE(trace.result.events.empty());
    for (const std::string& note : trace.result.notes) ADD_FAILURE() << note;
    for (const double p : {0.0, 0.05, 0.3, 0.77, 1.0}) {
      const ComplexVector s = trace.eigenvalues_at(p);
      ASSERT_EQ(s.size(), 2) << p;
      for (const Complex one : s) EXPECT_LT(std::abs(one + 2.0 * (1.0 + p)), 1e-13) << p;
    }
  }
}

/// K = 4 I + a Jordan block with p in its corner: s^2 = -4 - p^(1/8), an exceptional point of order eight.
TEST(SensitiveSpectra, EightEigenvaluesMeetAndPart) {
  constexpr int n = 8;
  const std::string K0 = matrix(n, [](int i, int k) { return i == k ? 4 : k == i + 1 ? 1 : 0; });
  const std::string K1 = matrix(n, [](int i, int k) { return i == n - 1 && k == 0 ? 1 : 0; });
  const RecordedTrace trace = completed_trace(family(n, identity(n), "", K0 + ", " + K1, -0.5, 0.7, 1e-9));
  const Event event = only_event(trace.result, EventKind::collision);
  EXPECT_NEAR(event.p, 0.0, 1e-12);
  EXPECT_EQ(event.modes.size(), 8U);
  EXPECT_NEAR(std::abs(event.puiseux), 0.25, 1e-6);
  for (const double p : {-0.4, 0.6}) {
    for (const Complex s : trace.eigenvalues_at(p))
      EXPECT_NEAR(std::abs(std::pow(s * s + 4.0, 8) - p), 0.0, 1e-6) << p;
  }
}

/// A mass on drag, free in a plane: two zeros, and -drag twice, for every drag.
TEST(SensitiveSpectra, ZerosOfAFreeParticleStayZero) {
  const RecordedTrace trace = completed_trace(
      make_setting("[parameters]\ndrag = 1.0\n[trace]\nparameter = \"drag\"\nfrom = 1.0\nto = "
                   "3.0\n[[point]]\nname = \"a\"\n"
                   "mass = 1\nposition = [0, 0, 0]\n[[fixed]]\npoint = \"a\"\ncoordinate = "
                   "\"z\"\n[[drag]]\npoint = \"a\"\n"
                   "coefficient = \"drag\"\n"));
  EXPECT_EQ(trace.result.certified_steps, trace.result.mode_steps);
  const ComplexVector s = trace.eigenvalues_at(2.0);
  EXPECT_EQ(std::count(s.begin(), s.end(), Complex(0.0)), 2);
  EXPECT_NEAR(std::abs(s.sum() + 4.0), 0.0, 1e-9);
}

/// s^2 + 0.1 s + 1 - 2 exp(-((p - c) / w)^2): on a bump of width 1e-3 of the range the stiffness becomes
/// negative: a divergence on either side of it.
TEST(SensitiveSpectra, ANarrowBumpIsNotSteppedOver) {
  constexpr double c = 0.3137;
  constexpr double w = 1e-3;
  const RecordedTrace trace = completed_trace(
      family(1, "[[1]]", "[[0.1]]", "[[\"1 - 2*exp(-((p - 0.3137)/1e-3)^2)\"]]", 0.0, 1.0, 1e-8));
  const std::vector<double> places = places_of(trace.result, EventKind::divergence);
  ASSERT_EQ(places.size(), 2U);
  const double half = w * std::sqrt(std::log(2.0));
  EXPECT_NEAR(places[0], c - half, 1e-10);
  EXPECT_NEAR(places[1], c + half, 1e-10);
}

/// The same as a mass on a spring with a damper: where the spring loses its stiffness, every position is an
/// equilibrium.
TEST(SensitiveSpectra, ANarrowBumpOfASpringIsNotSteppedOver) {
  const RecordedTrace trace = completed_trace(make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\ntolerance = 1e-8\n[parameters]\np = 0.0\n"
      "[[point]]\nname = \"a\"\nmass = 1\nposition = [0, 0, 0]\n"
      "[[fixed]]\npoint = \"a\"\ncoordinate = \"y\"\n[[fixed]]\npoint = \"a\"\ncoordinate = \"z\"\n"
      "[[spring]]\nfrom = [-1, 0, 0]\nto = \"a\"\nfree_length = 1\n"
      "stiffness = \"1 - 2*exp(-((p - 0.3137)/1e-3)^2)\"\n"
      "[[damper]]\nfrom = [-1, 0, 0]\nto = \"a\"\ncoefficient = 0.1\n"));
  const std::vector<double> places = places_of(trace.result, EventKind::branch_point);
  ASSERT_EQ(places.size(), 2U);
  const double half = 1e-3 * std::sqrt(std::log(2.0));
  for (const std::string& note : trace.result.notes)
    EXPECT_EQ(note.find("by the events that were found"), std::string::npos) << note;
  EXPECT_NEAR(places[0], 0.3137 - half, 1e-9);
  EXPECT_NEAR(places[1], 0.3137 + half, 1e-9);
}

/// An unbalanced disc without damping: x = 0.001 k / (k - omega^2), a pole at omega = 10.
TEST(SensitiveSpectra, APoleOfTheEquilibriumEndsTheTraceWithAReason) {
  const auto spring = [](const std::string& direction, const std::string& reference) {
    return "[[guided_spring]]\npoint = \"disc\"\ndirection = " + direction + "\nstiffness = 100\n" +
           reference;
  };
  const RecordedTrace trace = record_trace(make_setting(
      "[parameters]\nomega = 1.0\n[trace]\nparameter = \"omega\"\nfrom = 1.0\nto = 20.0\n[frame]\n"
      "angular_velocity = [0, 0, \"omega\"]\n[[point]]\nname = \"disc\"\nmass = 1\nposition = [0.001, 0, "
      "0]\n" +
      spring("[1, 0, 0]", "reference = 0.001\n") + spring("[0, 1, 0]", "") +
      "[[fixed]]\npoint = \"disc\"\ncoordinate = \"z\"\n"));
  EXPECT_EQ(trace.result.status, TraceStatus::step_too_small);
  EXPECT_NE(trace.result.message.find("runs to infinity"), std::string::npos) << trace.result.message;
  EXPECT_NEAR(trace.result.reached, 10.0, 1e-3);
  EXPECT_LT(trace.result.nodes, 200);
}

}  // namespace
}  // namespace eigentrail::test::sensitive_spectra_test
