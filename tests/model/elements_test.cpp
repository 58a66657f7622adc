// Every effect of the registry: automatic derivatives are compared with finite differences of the residual,
// by the observed order, declared properties with computed values, and results with closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::elements_test {
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
    {"preloaded_spring",
     "[[spring]]\nfrom = \"a\"\nto = \"c.tip\"\nstiffness = \"10*p\"\nfree_length = 0.4\npreload = "
     "\"3*p\"\n"},
    {"frame_and_bodies",
     "[frame]\nangular_velocity = [\"0.3*p\", 0.1, \"p\"]\n# a body is there: [[body]]\n"},
    {"gravity_on_bodies", "[gravity]\nacceleration = [\"p\", 2, -3]\n# a body is there: [[body]]\n"},
    {"drag_on_a_marker", "[[drag]]\npoint = { body = \"d\", at = [0.1, \"p\", 0.2] }\ncoefficient = \"p\"\n"},
    {"damper", "[[damper]]\nfrom = \"a\"\nto = \"c.tip\"\ncoefficient = \"p\"\n"},
    {"damper_between_bodies", "[[damper]]\nfrom = \"d\"\nto = \"c.tip\"\ncoefficient = \"p\"\n"},
    {"maxwell_damper",
     "[[maxwell_damper]]\nfrom = \"a\"\nto = \"c.tip\"\nstiffness = \"10*p\"\ncoefficient = \"2*p\"\n"
     "[[maxwell_damper]]\nfrom = [0.1, 0, \"p\"]\nto = \"b\"\nstiffness = 3\ncoefficient = 4\n"},
    {"torsional_maxwell_damper",
     "[[revolute]]\nname = \"hinge\"\nfrom = \"c.tip\"\nto = \"d\"\naxis = [1, 2, 3]\n"
     "[[torsional_maxwell_damper]]\njoint = \"hinge\"\nstiffness = \"4*p\"\ncoefficient = \"p^2\"\n"},
    {"moment", "[[moment]]\nbody = \"c\"\nalong = [1, \"p\", 2]\nmagnitude = \"3*p\"\n"},
    {"follower_moment", "[[moment]]\nbody = \"c\"\nalong = \"d.y\"\nmagnitude = \"3*p\"\n"},
    {"internal_damping",
     "[[internal_damping]]\npoint = \"c.tip\"\nabout = [0.1, 0.2, \"p\"]\naxis = [1, 0.2, 0.1]\ncoefficient "
     "= "
     "\"p\"\nspeed = \"20*p\"\n"},
    {"bearing",
     "[[bearing]]\npoint = \"c.tip\"\nseat = \"a\"\nfirst = [0, 1, \"p\"]\nsecond = [0, 0, 2]\nstiffness = "
     "[[\"5*p\", 1], [-2, 7]]\ndamping = [[1, \"p\"], [0.2, 2]]\n"},
    {"spinning_disc",
     "[[spinning_disc]]\naxis = { body = \"d\", along = [1, 2, \"p\"] }\npolar_inertia = "
     "0.3\nspeed = \"9*p\"\n"},
    {"torsional_spring",
     "[[revolute]]\nname = \"hinge\"\nfrom = \"c.tip\"\nto = \"d\"\naxis = [1, 2, 3]\n"
     "[[torsional_spring]]\njoint = \"hinge\"\nstiffness = \"4*p\"\nfree_angle = \"0.3*p\"\npreload = 2\n"},
    {"torsional_damper",
     "[[cylindrical]]\nname = \"hinge\"\nfrom = [0.1, 0, 0]\nto = \"d\"\naxis = \"d.y\"\n"
     "[[torsional_damper]]\njoint = \"hinge\"\ncoefficient = \"4*p\"\n"},
    {"torsion_about_either_axis",
     "[[universal]]\nname = \"cross\"\nfrom = \"c.tip\"\nto = \"d\"\naxis = \"c.x\"\ncross_axis = "
     "\"c.z\"\n"
     "[[torsional_spring]]\njoint = \"cross\"\nabout = \"axis\"\nstiffness = \"4*p\"\n"
     "[[torsional_spring]]\njoint = \"cross\"\nabout = \"cross_axis\"\nstiffness = 3\nfree_angle = \"p\"\n"},
    {"blade_element",
     "[frame]\nangular_velocity = [0, 0, \"9*p\"]\n"
     "[[blade_element]]\nbody = \"c\"\nroot = [0.1, 0, 0]\ntip = [\"2*p\", 0, 0]\nleading = [0, 1, "
     "0.1]\nlift = "
     "[0, 0, 1]\nchord = \"0.3*p\"\nprofile_drag = 0.02\npitch = \"0.2*p\"\ninflow = [0, 0.1, -1]\nstrips = "
     "2\n"},
    {"beam",
     "[[beam]]\nname = \"arm\"\nfrom = \"c.tip\"\nto = [2, \"p\", 0.3]\nelements = 1\ny_axis = [0.1, 1, 0]\n"
     "mass = \"p\"\nEA = \"9*p\"\nEI_flap = 2\nEI_lag = \"3*p\"\nGJ = 1.5\nGA_flap = 4\nGA_lag = 5\n"},
    {"beam_with_two_nodes_and_offsets",
     "[[beam]]\nname = \"arm\"\nfrom = [0, 0, \"p\"]\nto = \"d\"\nelements = 2\ndegree = 1\nspan = [0, 0.4, "
     "1]\n"
     "mass = [1, \"p\", 0.5]\nEA = [9, 8, 7]\nEI_flap = 2\nEI_lag = \"3*p\"\nGJ = 1.5\ntension_y = 0.1\n"
     "shear_z = \"0.1*p\"\ncentre_y = -0.05\ntwist = [0.2, 0.1, -0.1]\n# it ends at a body: [[body]]\n"},
    {"curved_beam",
     "[[beam]]\nname = \"arm\"\nfrom = [0, 0, 0.3]\nto = [0.9, 0.2, 0]\nelements = 1\nmass = 1\nEA = 9\n"
     "EI_flap = 2\nEI_lag = 3\nGJ = \"p\"\nspan = [0, 1, 2]\nsweep = [0, 0.1, 0]\nprebend = [0, 0.05, 0.2]\n"
     "twist = [0.2, 0.1, \"p\"]\n"},
    {"beam_damping",
     "[[beam]]\nname = \"arm\"\nfrom = [0, 0, 0]\nto = [\"p\", 0.2, 0.1]\nelements = 1\nmass = 1\nEA = 9\n"
     "EI_flap = 2\nEI_lag = 3\nGJ = 1.5\n[[beam_damping]]\nbeam = \"arm\"\ntime = \"0.1*p\"\n"},
    {"damping_by_strain",
     "[[beam]]\nname = \"arm\"\nfrom = [0, 0, 0]\nto = [\"p\", 0.2, 0.1]\nelements = 1\nmass = 1\nEA = 9\n"
     "EI_flap = 2\nEI_lag = 3\nGJ = 1.5\nshear_y = 0.2\n"
     "[[beam_damping]]\nbeam = \"arm\"\ntime = [0.1, 0, 0.2, \"0.3*p\", 0.4, 0.5]\n"},
    {"blade",
     "[[blade]]\nname = \"arm\"\nhub_radius = 0.2\nlength = \"p\"\nelements = 1\nmass = 1\nEA = 9\nGJ = 1.5\n"
     "EI_flap = \"2*p\"\nEI_lag = 3\npitch = \"0.3*p\"\nprecone = 0.1\nazimuth = 0.4\ndamping_flap = "
     "\"0.1*p\"\n"},
    {"strips_on_a_beam",
     "[frame]\nangular_velocity = [0, 0, \"9*p\"]\n"
     "[[beam]]\nname = \"arm\"\nfrom = [0.2, 0, 0]\nto = [\"p\", 0.2, 0.1]\nelements = 2\nmass = 1\nEA = 9\n"
     "EI_flap = 2\nEI_lag = 3\nGJ = 1.5\n"
     "[[strips]]\non = \"arm\"\nextent = [0.1, 0.8]\nspan = [0, 1]\nchord = [0.3, \"0.2*p\"]\n"
     "quarter_chord_y = 0.05\nincidence = [\"0.2*p\", 0.1]\nzero_lift_angle = -0.03\ndrag = 0.02\nmoment = "
     "-0.05\nwind = [0, 0, \"-2*p\"]\nstrips = 1\n"},
    {"strips_on_a_body",
     "[[strips]]\non = \"c\"\nroot = [0, 0.1, \"p\"]\ntip = [1, 0, \"p\"]\nleading = [0, 1, 0.2]\nchord = "
     "\"p\"\nlift_slope = 5\nwind = [1, \"-9*p\", 2]\ndensity = \"2*p\"\nstrips = 1\n"},
    {"lift_lag",
     "[[strips]]\non = \"c\"\nroot = [0, 0, 0]\ntip = [1, 0, \"p\"]\nchord = \"p\"\nwind = [1, \"-9*p\", "
     "2]\nzero_lift_angle = 0.1\nstrips = 1\n[[lift_lag]]\nA = [\"0.2*p\", 0.3]\n"},
    {"apparent_mass",
     "[frame]\nangular_velocity = [0, \"0.2*p\", \"9*p\"]\n"
     "[[strips]]\nname = \"air\"\non = \"c\"\nroot = [0, 0, 0]\ntip = [1, 0, \"p\"]\nchord = \"p\"\nwind = "
     "[0, \"-0.4*p\", \"-18*p\"]\nstrips = 1\n[[apparent_mass]]\nstrips = \"air\"\n"},
    {"inflow",
     "[frame]\nangular_velocity = [0, 0, \"9*p\"]\n"
     "[[inflow]]\nname = \"disc\"\nradius = \"2*p\"\ncentre = [0, 0.1, 0]\nwind = [0, 0, \"-2*p\"]\ndensity "
     "= "
     "\"p\"\n[[strips]]\non = \"c\"\nroot = [0.1, 0, 0]\ntip = [1, 0, \"p\"]\nchord = 0.2\nwind = [0, 0, "
     "\"-2*p\"]\nincidence = 0.3\ndrag = 0.01\ninflow = \"disc\"\nspeed_of_sound = \"50*p\"\nstrips = 1\n"
     "[[lift_lag]]\n"},
    {"uniform_inflow",
     "[frame]\nangular_velocity = [0, 0, \"9*p\"]\n"
     "[[inflow]]\nname = \"disc\"\nmodel = \"uniform\"\nradius = \"2*p\"\nblades = 3\nguess = 0.7\n"
     "[[strips]]\non = \"c\"\nroot = [0.1, 0, 0]\ntip = [1, 0, \"p\"]\nchord = 0.2\ninflow = "
     "\"disc\"\nstrips = "
     "1\n"},
    {"ball", "[[ball]]\nfrom = \"a\"\nto = \"c.tip\"\n"},
    {"revolute_held",
     "[[revolute]]\nfrom = \"c\"\nto = \"d\"\naxis = { body = \"c\", along = [1, 1, \"p\"] }\nangle = "
     "\"p\"\n"},
    {"coupler",
     "[[revolute]]\nname = \"hinge\"\nfrom = \"c.tip\"\nto = \"d\"\naxis = [1, 2, 3]\n"
     "[[cylindrical]]\nname = \"guide\"\nfrom = [0, \"p\", 0.2]\nto = \"c\"\naxis = [1, \"p\", 0]\n"
     "[[coupler]]\njoints = [\"hinge\", \"guide\", \"guide.slide\"]\nratios = [\"p\", -2, \"3*p\"]\n"},
    {"coupled_universal_joint",
     "[[universal]]\nname = \"cross\"\nfrom = \"c.tip\"\nto = \"d\"\naxis = \"c.x\"\ncross_axis = "
     "\"c.z\"\n"
     "[[coupler]]\njoints = [\"cross.axis\", \"cross.cross_axis\"]\nratios = [\"10*p\", 7]\n"},
    {"gear",
     "[[revolute]]\nname = \"pinion\"\nfrom = [0.1, 0, 0]\nto = \"c\"\naxis = [1, 2, \"p\"]\n"
     "[[revolute]]\nname = \"ring\"\nfrom = \"d\"\nto = [0, \"p\", 0]\naxis = [-1, -2, \"-p\"]\n"
     "[[gear]]\njoints = [\"pinion\", \"ring\"]\nteeth = [\"10*p\", 7]\ninternal = true\n"},
    {"prismatic", "[[prismatic]]\nfrom = \"c\"\nto = \"d\"\naxis = \"c.x\"\nlength = \"p\"\n"},
    {"prismatic_free", "[[prismatic]]\nfrom = [0, 0, \"p\"]\nto = \"d\"\naxis = [\"p\", 1, 0]\n"},
    {"weld", "[[weld]]\nfrom = \"c.tip\"\nto = \"d\"\n"},
    {"point_on_line", "[[point_on_line]]\nfrom = \"c\"\nto = \"a\"\naxis = \"c.y\"\n"},
    {"point_on_plane",
     "[[point_on_plane]]\nfrom = \"c.tip\"\nto = \"d\"\nnormal = \"c.y\"\ndistance = \"p^2\"\n"},
};

/// Two bodies in general position, for the cases that name one.
const std::string bodies =
    "[[body]]\nname = \"c\"\nmass = \"1 + p\"\ncentre = [0.1, \"0.2*p\", -0.3]\ninertia = [[2, 0.1, 0.2], "
    "[0.1, 3, \"0.1*p\"], [0.2, \"0.1*p\", 2.5]]\nposition = [0.4, 0.1, \"-0.7*p\"]\n"
    "euler = { sequence = \"zyx\", angles = [0.4, \"0.3*p\", -0.2] }\nmarkers = { tip = [1, 0.1, \"p\"] }\n"
    "[[body]]\nname = \"d\"\nmass = 2\ninertia = [1, 1.2, 0.9]\nposition = [-0.4, 1.1, 0.7]\n"
    "axis_angle = { axis = [1, 2, 3], angle = \"p\" }\n";

bool names_a_body(const std::string& tables) {
  for (const char* name : {"[[body]]", "\"c\"", "\"c.", "\"d\"", "\"d."}) {
    if (tables.find(name) != std::string::npos) return true;
  }
  return false;
}

std::string scene_with(const std::string& tables) {
  return "[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 1\n"
         "[parameters]\np = 0.7\n" +
         tables +
         "[[point]]\nname = \"a\"\nmass = \"2 + p\"\nposition = [0.3, -0.2, 0.9]\n"
         "[[point]]\nname = \"b\"\nmass = 1.5\nposition = [-0.6, 0.8, 0.1]\n" +
         (names_a_body(tables) ? bodies : "");
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
  moving.x = VectorSeries::Zero(x.size(), 3);
  moving.x.col(0) = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    moving.x(i, 1) = 0.5 * std::sin(1.3 * static_cast<double>(i) + 1.0);
    moving.x(i, 2) = 0.3 * std::cos(2.1 * static_cast<double>(i));
  }
  moving.lambda = VectorSeries::Constant(lambda.size(), 2, 1.7);
  Linearization series;
  ASSERT_FALSE(setting.model->linearize(moving, 4, series, counts));
  const auto error_at = [&](double h) {
    Linearization ahead;
    const Path there{evaluate_series(moving.parameters, h), evaluate_series(moving.x, h),
                     evaluate_series(moving.lambda, h)};
    EXPECT_FALSE(setting.model->linearize(there, 0, ahead, counts));
    const auto miss = [h](const SystemSeries& s, const SystemMatrix& exact) {
      Matrix value = s.back().dense();
      for (std::size_t k = s.size() - 1; k-- > 0;) value = value * h + s[k].dense();
      return (value - exact.dense()).norm();
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

/// The same records with 113 bits: the results differ only by the rounding of double precision.
TEST_P(Elements, AgreesWithExtendedPrecision) {
  Linearization lin;
  SteadyResidual residual;
  ASSERT_FALSE(setting.model->linearize(path, 0, lin, counts));
  ASSERT_FALSE(setting.model->residual(path, 0, residual, counts));
  const BasicPath<Extended> exact{path.parameters.cast<Extended>(), path.x.cast<Extended>(),
                                  path.lambda.cast<Extended>()};
  BasicLinearization<Extended> exact_lin;
  BasicSteadyResidual<Extended> exact_residual;
  ASSERT_FALSE(setting.model->extended_linearization(exact, exact_lin));
  ASSERT_FALSE(setting.model->extended_residual(exact, exact_residual));
  const auto close = [](const Matrix& a, const Matrix& b) {
    return (a - b).norm() <= 1e-14 * (1.0 + b.norm());
  };
  EXPECT_TRUE(close(lin.M[0].dense(), to_double(exact_lin.M[0].dense())));
  EXPECT_TRUE(close(lin.C[0].dense(), to_double(exact_lin.C[0].dense())));
  EXPECT_TRUE(close(lin.K[0].dense(), to_double(exact_lin.K[0].dense())));
  EXPECT_TRUE(close(lin.A[0].dense(), to_double(exact_lin.A[0].dense())));
  EXPECT_TRUE(close(residual.force, to_double(exact_residual.force)));
  EXPECT_TRUE(close(residual.constraint, to_double(exact_residual.constraint)));
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
  const Matrix K = lin.K[0].dense();
  const Matrix C = lin.C[0].dense();
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
    if (effect.name == "rotor")
      continue;  // makes blades of what others are: tests/scenes/hammond_ground_resonance_test.py
    if (effect.name == "trim") continue;  // no effect: tests/steady/trim_test.cpp
    const bool found = std::any_of(cases.begin(), cases.end(), [&](const ElementCase& c) {
      return c.tables.find("[" + effect.name + "]") != std::string::npos;
    });
    EXPECT_TRUE(found) << effect.name;
  }
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
}  // namespace eigentrail::test::elements_test
