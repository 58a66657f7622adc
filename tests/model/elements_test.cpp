// Every effect of the registry: automatic derivatives against finite differences of the residual by observed
// order, declared facts against what the numbers show, and closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "model/registry.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

/// A scene that has the effect under test, two free points in general position, and parameters that enter it.
struct ElementCase {
  std::string name;
  std::string tables;
};

const std::vector<ElementCase> cases = {
    {"frame", "[frame]\nangular_velocity = [\"0.3*p\", 0.1, \"p\"]\n"},
    {"gravity", "[gravity]\nacceleration = [\"p\", 2, \"-9.81*p\"]\n"},
    {"force", "[[force]]\npoint = \"a\"\ncomponents = [\"p^2\", 1, \"sin(p)\"]\n"},
    {"follower_force_along",
     "[[follower_force]]\npoint = \"a\"\nfrom = \"b\"\nto = \"a\"\nmagnitude = \"3*p\"\n"},
    {"follower_force_turned",
     "[[follower_force]]\npoint = \"b\"\nfrom = [0.1, 0, 0]\nto = \"a\"\nmagnitude = 2\nangle = \"p\"\naxis "
     "= [1, 2, \"p\"]\n"},
    {"transverse_force",
     "[[transverse_force]]\npoint = \"a\"\nhinge = \"b\"\ntangential = \"-p\"\nnormal = \"2*p\"\n"},
    {"spring", "[[spring]]\nfrom = \"a\"\nto = \"b\"\nstiffness = \"10*p\"\nfree_length = 0.4\n"},
    {"spring_to_place", "[[spring]]\nfrom = [\"p\", 0, 0]\nto = \"b\"\nstiffness = 7\nfree_length = \"p\"\n"},
    {"guided_spring",
     "[[guided_spring]]\npoint = \"a\"\ndirection = [1, \"p\", 2]\nstiffness = 5\nreference = \"p\"\n"},
    {"drag", "[[drag]]\npoint = \"a\"\ncoefficient = \"p\"\n"},
    {"rod", "[[rod]]\nfrom = \"a\"\nto = \"b\"\nlength = \"p\"\n"},
    {"rod_to_place", "[[rod]]\nfrom = [0, \"p\", 0]\nto = \"b\"\nlength = 1.3\n"},
    {"plane", "[[plane]]\npoint = \"a\"\nnormal = [1, \"p\", 3]\noffset = \"p^2\"\n"},
    {"fixed", "[[fixed]]\npoint = \"b\"\ncoordinate = \"y\"\nvalue = \"p\"\n"},
};

std::string scene_with(const std::string& tables) {
  return "[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 1\n"
         "[parameters]\np = 0.7\n" +
         tables +
         "[[point]]\nname = \"a\"\nmass = \"2 + p\"\nposition = [0.3, -0.2, 0.9]\n"
         "[[point]]\nname = \"b\"\nmass = 1.5\nposition = [-0.6, 0.8, 0.1]\n";
}

class Elements : public testing::TestWithParam<ElementCase> {
 protected:
  void SetUp() override {
    setting = make_setting(scene_with(GetParam().tables));
    counts = setting.model->new_counts();
    x = setting.model->initial_guess(setting.scene.parameters.declared_values());
    lambda = Vector::Constant(setting.model->n_constraints(), 1.7);
    path = {setting.scene.parameters.declared_values(), x, lambda};
  }

  Vector force_at(const Vector& position) {
    SteadyResidual residual;
    EXPECT_FALSE(setting.model->residual({path.parameters, position, lambda}, 0, residual, counts));
    return residual.force.col(0);
  }
  Vector constraint_at(const Vector& position) {
    SteadyResidual residual;
    EXPECT_FALSE(setting.model->residual({path.parameters, position, lambda}, 0, residual, counts));
    return residual.constraint.col(0);
  }

  Setting setting;
  EvaluationCounts counts;
  Vector x, lambda;
  Path path;
};

/// Central difference in direction d with step h.
template <class Function>
Vector central(Function&& f, const Vector& x, const Vector& d, double h) {
  return (f(x + h * d) - f(x - h * d)) / (2.0 * h);
}

/// Central differences approach `exact` with second order, or agree to rounding at once.
void expect_second_order(const Vector& coarse, const Vector& fine, const Vector& exact) {
  const double coarse_error = (coarse - exact).norm();
  const double fine_error = (fine - exact).norm();
  const double rounding = 1e-9 * (1.0 + exact.norm());
  if (coarse_error < rounding) {
    EXPECT_LT(fine_error, rounding);
  } else {
    EXPECT_NEAR(std::log2(coarse_error / fine_error), 2.0, 0.2)
        << "errors " << coarse_error << ", " << fine_error;
  }
}

TEST_P(Elements, StiffnessIsTheGradientOfTheResidual) {
  Linearization lin;
  ASSERT_FALSE(setting.model->linearize(path, 0, lin, counts));
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Vector d = Vector::Unit(x.size(), j);
    const auto f = [&](const Vector& at) { return force_at(at); };
    expect_second_order(central(f, x, d, 2e-3), central(f, x, d, 1e-3), lin.K[0].dense().col(j));
  }
}

TEST_P(Elements, ConstraintJacobianIsTheGradientOfTheConstraint) {
  Linearization lin;
  ASSERT_FALSE(setting.model->linearize(path, 0, lin, counts));
  for (Eigen::Index j = 0; j < x.size() && lambda.size() > 0; ++j) {
    const auto c = [&](const Vector& at) { return constraint_at(at); };
    const Vector d = Vector::Unit(x.size(), j);
    expect_second_order(central(c, x, d, 2e-3), central(c, x, d, 1e-3), lin.A[0].dense().col(j));
  }
}

TEST_P(Elements, SeriesAlongAPathReproduceTheMatricesAheadWithFifthOrder) {
  // x, lambda and p all move; the truncated series of order 4 misses the matrices at distance h by O(h^5).
  Path moving;
  moving.parameters = VectorSeries{{0.7, 1.0}};
  moving.x = VectorSeries::Zero(6, 3);
  moving.x << x, Vector{{0.4, -0.3, 0.2, 0.1, 0.5, -0.6}}, Vector{{0.1, 0.2, -0.1, 0.3, 0.0, 0.1}};
  moving.lambda = VectorSeries::Constant(lambda.size(), 2, 1.7);
  Linearization series;
  ASSERT_FALSE(setting.model->linearize(moving, 4, series, counts));
  const auto error_at = [&](double h) {
    Linearization ahead;
    const Path there{evaluate_series(moving.parameters, h), evaluate_series(moving.x, h),
                     evaluate_series(moving.lambda, h)};
    EXPECT_FALSE(setting.model->linearize(there, 0, ahead, counts));
    const auto miss = [h](const SystemSeries& s, const Matrix& exact) {
      Matrix value = s.back();
      for (std::size_t k = s.size() - 1; k-- > 0;) value = value * h + s[k].dense();
      return (value - exact).norm();
    };
    return miss(series.M, ahead.M[0]) + miss(series.C, ahead.C[0]) + miss(series.K, ahead.K[0]) +
           miss(series.A, ahead.A[0]);
  };
  const double coarse = error_at(0.04);
  const double fine = error_at(0.02);
  if (coarse < 1e-11) {
    EXPECT_LT(fine, 1e-11);  // polynomial in h
  } else {
    EXPECT_GT(std::log2(coarse / fine), 4.5) << "errors " << coarse << ", " << fine;
  }
}

TEST_P(Elements, DeclaredContributionsAgreeWithTheMatrices) {
  Linearization lin;
  ASSERT_FALSE(setting.model->linearize(path, 0, lin, counts));
  Contribution all;
  for (const Effect& effect : setting.model->description().effects) {
    if (effect.count == 0) continue;
    all.circulatory |= effect.contribution.circulatory;
    all.dissipative |= effect.contribution.dissipative;
    all.gyroscopic |= effect.contribution.gyroscopic;
  }
  const Matrix K = lin.K[0];
  const Matrix C = lin.C[0];
  const double K_skew = (K - K.transpose()).norm();
  const double C_skew = (C - C.transpose()).norm();
  const double C_symmetric = (C + C.transpose()).norm();
  EXPECT_EQ(K_skew > 1e-12, all.circulatory);
  EXPECT_EQ(C_skew > 1e-12, all.gyroscopic);
  EXPECT_EQ(C_symmetric > 1e-12, all.dissipative);
}

INSTANTIATE_TEST_SUITE_P(Registry, Elements, testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });

TEST(Registry, EveryEffectHasACase) {
  for (const EffectHelp& effect : effect_reference()) {
    if (effect.name == "point") continue;  // in every case
    const bool found = std::any_of(cases.begin(), cases.end(), [&](const ElementCase& c) {
      return c.tables.find("[" + effect.name + "]") != std::string::npos;
    });
    EXPECT_TRUE(found) << effect.name;
  }
}

/// The derivative in a direction an element does not declare must vanish: a forgotten declaration would
/// silently drop a matrix.
TEST(Registry, DeclaredDependencesAreComplete) {
  using Base = Series<double, 0>;
  using Scalar = Series<Base, 1>;
  PathValues<Base> values;
  for (int i = 0; i < 12; ++i) values.x.emplace_back(0.3 + 0.17 * i * i);
  for (int i = 0; i < 20; ++i) values.values.emplace_back(1.1 + 0.3 * i);
  const auto place = [](int point) { return Place{point, {}}; };
  int slot = 0;
  const auto number = [&slot] { return Quantity{{}, slot++ % 20}; };
  const auto vector = [&] { return std::array<Quantity, 3>{number(), number(), number()}; };

  const auto check = [&](const auto& element, std::vector<int> points) {
    using Element = std::decay_t<decltype(element)>;
    for (const auto& [declared, motion] : {std::pair(Element::depends.position, Motion::position),
                                           std::pair(Element::depends.velocity, Motion::velocity),
                                           std::pair(Element::depends.acceleration, Motion::acceleration)}) {
      double largest = 0.0;
      for (const int point : points) {
        for (int axis = 0; axis < 3; ++axis) {
          ElementView<Scalar> view(values, points, {}, {Seed{motion, 3 * point + axis}});
          element.force(view);
          for (std::size_t i = 0; i < points.size(); ++i) {
            for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(view.force(i)[j][1][0]));
          }
        }
      }
      EXPECT_EQ(declared, largest > 0.0) << Element::name << " motion " << static_cast<int>(motion);
    }
  };
  check(PointMass{place(0), number()}, {0});
  check(RotatingFrame{place(0), number(), vector()}, {0});
  check(Gravity{place(0), number(), vector()}, {0});
  check(DeadForce{place(0), vector()}, {0});
  check(FollowerForce{place(0), place(1), place(2), number(), number(), vector()}, {0, 1, 2});
  check(TransverseForce{place(0), place(1), number(), number()}, {0, 1});
  check(Spring{place(0), place(1), number(), number()}, {0, 1});
  check(GuidedSpring{place(0), vector(), number(), number()}, {0});
  check(Drag{place(0), number()}, {0});
}

TEST(Registry, CoincidingSpringEndsAreReportedByName) {
  const Setting setting = make_setting(
      "[trace]\nparameter = \"k\"\nfrom = 1\nto = 2\n[parameters]\nk = 1\n"
      "[[point]]\nname = \"a\"\nmass = 1\nposition = [1, 2, 3]\n"
      "[[spring]]\nname = \"short one\"\nfrom = [1, 2, 3]\nto = \"a\"\nstiffness = \"k\"\nfree_length = "
      "0.1\n");
  EvaluationCounts counts = setting.model->new_counts();
  const Path path{Vector{{1.0}}, Vector{{1.0, 2.0, 3.0}}, Vector()};
  Linearization lin;
  EXPECT_EQ(setting.model->linearize(path, 2, lin, counts).source, "short one");
}

}  // namespace
}  // namespace eigentrail::test
