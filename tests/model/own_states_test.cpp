// Elements with states of their own: the Maxwell damper against closed forms, the same equations as a family
// of matrices, and large displacements; its coordinates, guesses, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/core/errors.hpp"
#include "scene/input_error.hpp"
#include "support/resumed.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::own_states_test {
namespace {

constexpr double mass = 2.0, beside = 50.0, spring = 30.0, dashpot = 1.5;

/// A mass on a spring with a Maxwell damper beside it; `range` has parameter, from and to of the trace.
std::string oscillator(const std::string& range, double c = dashpot) {
  return "[parameters]\nm = 2\nbeside = 50\nk = 30\nc = " + std::to_string(c) +
         "\n[trace]\ntolerance = 1e-11\n" + range +
         "[[point]]\nname = \"bob\"\nmass = \"m\"\nposition = [1.3, 0, 0]\n"
         "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n[[fixed]]\npoint = \"bob\"\ncoordinate = \"z\"\n"
         "[[spring]]\nfrom = [0, 0, 0]\nto = \"bob\"\nstiffness = \"beside\"\nfree_length = 1\n"
         "[[maxwell_damper]]\nfrom = [0, 0, 0]\nto = \"bob\"\nstiffness = \"k\"\ncoefficient = \"c\"\n";
}

std::string range(const std::string& parameter, double from, double to) {
  return "parameter = \"" + parameter + "\"\nfrom = " + std::to_string(from) +
         "\nto = " + std::to_string(to) + "\n";
}

/// Roots of (m s^2 + a)(c s + k) + k c s with Im s >= 0, from its companion matrix.
ComplexVector cubic(double m, double a, double k, double c) {
  Matrix companion = Matrix::Zero(3, 3);
  companion(1, 0) = companion(2, 1) = 1.0;
  companion.col(2) << -a * k / (m * c), -(a + k) / m, -k / c;
  const ComplexVector all = companion.eigenvalues();
  std::vector<Complex> upper;
  for (const Complex s : all) {
    if (s.imag() >= 0.0) upper.push_back(s);
  }
  return Eigen::Map<const ComplexVector>(upper.data(), static_cast<Eigen::Index>(upper.size()));
}

/// Largest relative distance of `found` from the nearest of `expected`, which must be as many.
double distance(const ComplexVector& found, const ComplexVector& expected) {
  EXPECT_EQ(found.size(), expected.size());
  double worst = 0.0;
  for (const Complex s : expected)
    worst = std::max(worst, (found.array() - s).abs().minCoeff() / std::abs(s));
  return worst;
}

struct Traced {
  std::string parameter;
  double from, to;
};

class MaxwellDamper : public testing::TestWithParam<Traced> {
 protected:
  static ComplexVector expected(const std::string& parameter, double p) {
    const auto value = [&](const char* name, double otherwise) { return parameter == name ? p : otherwise; };
    return cubic(value("m", mass), value("beside", beside), value("k", spring), value("c", dashpot));
  }
};

TEST_P(MaxwellDamper, AddsTheRealRootOfTheCubic) {
  const auto& [parameter, from, to] = GetParam();
  const RecordedTrace recorded = completed_trace(make_setting(oscillator(range(parameter, from, to))));
  EXPECT_EQ(recorded.result.n_modes, 2);
  EXPECT_EQ(recorded.result.n_infinite, 0);
  EXPECT_TRUE(recorded.result.notes.empty());
  for (int i = 0; i <= 200; ++i) {
    const double p = i == 200 ? to : from + (to - from) * i / 200.0;
    EXPECT_LT(distance(recorded.eigenvalues_at(p), expected(parameter, p)), 1e-10) << parameter << " = " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Parameters, MaxwellDamper,
                         testing::Values(Traced{"c", 0.1, 100.0}, Traced{"c", 100.0, 0.1},
                                         Traced{"k", 0.001, 1000.0}, Traced{"m", 0.5, 5.0},
                                         Traced{"beside", 1.0, 400.0}),
                         [](const auto& tested) {
                           return tested.param.parameter +
                                  (tested.param.from > tested.param.to ? "_down" : "");
                         });

TEST(OwnStates, AreNamedCoordinatesBehindThoseOfPointsAndBodies) {
  const Setting setting = make_setting(oscillator(range("c", 1, 2)));
  const ModelDescription& description = setting.model->description();
  EXPECT_EQ(description.coordinate_names,
            (std::vector<std::string>{"bob.x", "bob.y", "bob.z", "maxwell_damper 1.dashpot"}));
  EXPECT_EQ(description.coordinate_units.back(), "m");
  for (const Effect& effect : description.effects)
    EXPECT_EQ(effect.states, effect.name == "maxwell_damper" ? 1 : 0);
  const Setting without = make_setting(oscillator(range("m", 1, 2)), {{"without", "maxwell_damper"}});
  EXPECT_EQ(without.model->n_coordinates(), 3);
}

TEST(OwnStates, ReferenceListsThem) {
  for (const EffectHelp& effect : effect_reference()) {
    const bool has = effect.name == "maxwell_damper" || effect.name == "torsional_maxwell_damper";
    EXPECT_EQ(effect.states.size(), has ? 1U : effect.name == "lift_lag" ? 2U : 0U) << effect.name;
  }
}

TEST(OwnStates, StartWhereTheirEquationsHold) {
  const Setting setting = make_setting(oscillator(range("c", 1, 2)));
  const Vector guess = setting.model->initial_guess(setting.scene.parameters.declared_values());
  EXPECT_DOUBLE_EQ(guess[3], 1.3);  // the elongation from the fixed place to the guess of the bob
}

TEST(OwnStates, HaveExactZerosInTheMassMatrixOfTheReducedPencil) {
  const RecordedTrace recorded = completed_trace(
      make_setting(oscillator(range("k", 10, 40)) +
                   "[[point]]\nname = \"far\"\nmass = 1\nposition = [3, 0, 4]\n"
                   "[[rod]]\nfrom = \"bob\"\nto = \"far\"\nlength = 5\n[gravity]\nacceleration = [3, 1, 4]\n"
                   "[[maxwell_damper]]\nfrom = [0, 2, 1]\nto = \"far\"\nstiffness = 5\ncoefficient = 2\n"));
  for (const PathNode& node : recorded.nodes) {
    const Matrix& M = node.pencil.M[0];
    EXPECT_EQ(M.rows(), 5);
    EXPECT_TRUE(M.rightCols(2).isZero(0.0) && M.bottomRows(2).isZero(0.0));
    EXPECT_TRUE(node.basis.T[0].bottomRightCorner(2, 2).isIdentity(0.0));
  }
}

/// A pendulum pushed along its circle stands at sin(angle) = p, between -70 and 70 degrees. The tension of
/// the damper is zero at every equilibrium; its elongation per angle is that of the distance from its far
/// end.
TEST(OwnStates, FollowLargeDisplacements) {
  const double k = 20.0, c = 3.0, length = 1.5, weight = 9.81;
  const Setting setting = make_setting(
      "[parameters]\np = 0\n[trace]\nparameter = \"p\"\nfrom = -0.94\nto = 0.94\ntolerance = 1e-11\n"
      "[gravity]\nacceleration = [0, 0, -9.81]\n"
      "[[point]]\nname = \"bob\"\nmass = 1\nposition = [\"1.5*p\", 0, \"-1.5*sqrt(1 - p^2)\"]\n"
      "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = 1.5\n[[fixed]]\npoint = \"bob\"\ncoordinate = "
      "\"y\"\n"
      "[[transverse_force]]\npoint = \"bob\"\nhinge = [0, 0, 0]\ntangential = 0\nnormal = 0\n"
      "[[follower_force]]\npoint = \"bob\"\nfrom = [0, 0, 0]\nto = \"bob\"\nmagnitude = \"9.81*p\"\n"
      "angle = \"-pi/2\"\naxis = [0, 1, 0]\n"
      "[[maxwell_damper]]\nfrom = [0.8, 0, 0.3]\nto = \"bob\"\nstiffness = 20\ncoefficient = 3\n");
  const RecordedTrace recorded = completed_trace(setting);
  for (const PathNode& node : recorded.nodes) {
    const double x = node.path.x(0, 0), z = node.path.x(2, 0);
    EXPECT_NEAR(x, length * node.p, 1e-10);
    const double dx = x - 0.8, dz = z - 0.3;
    const double distance_now = std::hypot(dx, dz);
    EXPECT_NEAR(node.path.x(3, 0), distance_now, 1e-10);
    // Per angle, the bob moves by (-z, x) and lengthens the damper by `arm`.
    const double arm = (dx * -z + dz * x) / distance_now;
    const ComplexVector expected = cubic(length * length, weight * std::sqrt(1.0 - node.p * node.p) * length,
                                         k * arm * arm, c * arm * arm);
    EXPECT_LT(distance(recorded.eigenvalues_at(node.p), expected), 1e-9) << node.p;
  }
}

/// Without a dashpot the spring hangs loose: no force, and an infinite eigenvalue, which is no mode.
TEST(OwnStates, ADashpotOfZeroGivesNoForceAndNoMode) {
  const RecordedTrace recorded = completed_trace(make_setting(oscillator(range("m", 1, 4), 0.0)));
  EXPECT_EQ(recorded.result.n_available, 1);
  EXPECT_EQ(recorded.result.n_infinite, 1);
  for (const double m : {1.0, 2.3, 4.0})
    EXPECT_LT(std::abs(recorded.eigenvalues_at(m)[0] - Complex(0.0, std::sqrt(beside / m))),
              1e-10 * std::sqrt(beside / m));
}

/// The eigenvalue comes from infinity as the dashpot grows from zero, and is found on the way.
TEST(OwnStates, TheEigenvalueOfADashpotThatGrowsFromZeroIsFound) {
  const RecordedTrace recorded = completed_trace(make_setting(oscillator(range("c", 0, 5))));
  EXPECT_LT(distance(recorded.eigenvalues_at(5.0), cubic(mass, beside, spring, 5.0)), 1e-10);
  EXPECT_EQ(recorded.result.n_columns, 2);
}

TEST(OwnStates, ResumedTracesAreTheSameBitForBit) {
  const Setting setting = make_setting(oscillator(range("k", 1, 200)));
  EXPECT_EQ(first_resumed_difference(*setting.model, setting.options, 5), "");
}

struct Refused {
  std::string name, table, message;
};

class RefusedMaxwellDamper : public testing::TestWithParam<Refused> {};

TEST_P(RefusedMaxwellDamper, SaysWhat) {
  const std::string text =
      "[parameters]\np = 1\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n"
      "[[point]]\nname = \"a\"\nmass = \"p\"\nposition = [1, 0, 0]\n" +
      GetParam().table;
  const std::string message = input_error([&] { (void)make_setting(text); });
  EXPECT_TRUE(contains(message, GetParam().message)) << message;
}

const std::string ends = "[[maxwell_damper]]\nfrom = [0, 0, 0]\nto = \"a\"\n";

INSTANTIATE_TEST_SUITE_P(
    Tables, RefusedMaxwellDamper,
    testing::Values(
        Refused{"no_stiffness", ends + "coefficient = 1\n", "stiffness"},
        Refused{"no_coefficient", ends + "stiffness = 1\n", "coefficient"},
        Refused{"zero_stiffness", ends + "stiffness = 0\ncoefficient = 1\n", "stiffness: must be positive"},
        Refused{"negative_stiffness", ends + "stiffness = -2\ncoefficient = 1\n", "must be positive"},
        Refused{"stiffness_that_vanishes", ends + "stiffness = \"2 - p\"\ncoefficient = 1\n",
                "must be positive"},
        Refused{"negative_coefficient", ends + "stiffness = 1\ncoefficient = -1\n",
                "coefficient: must not be negative"},
        Refused{"unknown_key", ends + "stiffness = 1\ncoefficient = 1\nfree_length = 1\n", "free_length"},
        Refused{"no_end", "[[maxwell_damper]]\nfrom = [0, 0, 0]\nstiffness = 1\ncoefficient = 1\n", "to"},
        Refused{"fixed_ends",
                "[[maxwell_damper]]\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nstiffness = 1\ncoefficient = 1\n",
                "joins no moving point"},
        Refused{"no_joint", "[[torsional_maxwell_damper]]\njoint = \"lag\"\nstiffness = 1\ncoefficient = 1\n",
                "joint"},
        Refused{"a_name_twice",
                ends + "name = \"d\"\nstiffness = 1\ncoefficient = 1\n" + ends +
                    "name = \"d\"\nstiffness = 1\ncoefficient = 1\n",
                "is called 'd' already"}),
    [](const auto& tested) { return tested.param.name; });

/// A row of masses on springs with Maxwell dampers to the ground, and its matrices; C is c times the one
/// here.
struct Row {
  static constexpr int count = 40;
  std::string scene =
      "[parameters]\nc = 1\n[trace]\nparameter = \"c\"\nfrom = 0.5\nto = 4\ntolerance = 1e-9\nmodes = 6\n";
  Matrix M = Matrix::Zero(2 * count, 2 * count), C = M, K = M;

  Row() {
    for (int i = 0; i < count; ++i) {
      const double m = 1.0 + 0.05 * i, k = 1 + i % 3;
      add_tables(i, m, k);
      const int u = count + i;
      M(i, i) = m;
      C(u, u) = 1.0;
      K(i, i) += 100.0 + k;
      K(u, u) = k;
      K(i, u) = K(u, i) = -k;
      if (i == 0) continue;
      K(i - 1, i - 1) += 100.0;
      K(i, i - 1) = K(i - 1, i) = -100.0;
    }
  }

  void add_tables(int i, double m, double k) {
    const auto name = [](int j) { return "\"p" + std::to_string(j) + "\""; };
    scene += "[[point]]\nname = " + name(i) + "\nmass = " + std::to_string(m) + "\nposition = [" +
             std::to_string(i + 1) + ", 0, 0]\n";
    for (const char* axis : {"\"y\"", "\"z\""})
      scene += "[[fixed]]\npoint = " + name(i) + "\ncoordinate = " + axis + "\n";
    scene += "[[spring]]\nfrom = " + (i == 0 ? "[0, 0, 0]" : name(i - 1)) + "\nto = " + name(i) +
             "\nstiffness = 100\nfree_length = 1\n[[maxwell_damper]]\nfrom = [-1, 0, 0]\nto = " + name(i) +
             "\nstiffness = " + std::to_string(k) + "\ncoefficient = \"c\"\n";
  }
};

/// So many coordinates that matrices are sparse.
TEST(OwnStates, WorkWithSparseMatrices) {
  const Row row;
  const Setting setting = make_setting(row.scene);
  const RecordedTrace recorded = completed_trace(setting);
  EXPECT_TRUE(recorded.nodes[0].linearization.K[0].is_sparse());
  for (const double c : {0.5, 1.7, 4.0}) {
    const Spectrum spectrum = compute_spectrum(row.M, c * row.C, row.K);
    ASSERT_EQ(spectrum.status, SpectrumStatus::complete);
    int followed = 0;
    for (const Complex s : recorded.eigenvalues_at(c)) {
      if (std::isnan(s.real())) continue;  // a column of modes that were not there yet, or met
      double miss = INFINITY;
      for (const StartingMode& mode : spectrum.modes) miss = std::min(miss, std::abs(mode.s - s));
      EXPECT_LT(miss, 1e-8 * std::abs(s)) << s;
      ++followed;
    }
    EXPECT_GE(followed, 6);
  }
}

}  // namespace
}  // namespace eigentrail::test::own_states_test
