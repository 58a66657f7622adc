// Rotors: the matrices that shafts, discs and bearings make, and their derivatives along a path.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "eigentrail/core/text.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::rotor_test {
namespace {

/// A rotor all of whose quantities depend on p.
const std::string everything = R"(
trace = { parameter = "p", from = 0.5, to = 1 }
parameters = { p = 0.7 }
disc = [
  { node = "inner node 2", mass = "20*p", Id = "0.2*p", Ip = "0.35*p^2" },
  { node = "outer node 3", outer = "0.3*p", width = 0.02, density = 7800 },
]
support = [{ node = ["outer 3"] }]
[[shaft]]
name = "inner"
stations = { length = ["0.3 + 0.1*p", 0.5], outer = [0.05, "0.06*p"], inner = ["0.02*p", 0] }
elements = [1, 2]
E = "2.1e11*p"
nu = "0.3*p"
density = "7800*p^2"
speed = "300*p"
alpha = "p"
beta = "1e-5*p"
internal_damping = "2e-5*p"
refined = true
axial = true
torsion = true
[[shaft]]
name = "outer"
stations = { length = 0.4, outer = 0.1, inner = 0.08 }
elements = 2
E = 2e11
G = "8e10*p^0.1"
density = 7800
speed = "-450*p"
[[bearing]]
node = "inner 1"
kxx = "1e7*p"
kxy = "2e6*p^2"
kyx = "-1e6*p"
kyy = 2e7
cxx = "1e3*p"
cxy = "10*p"
mxx = "3*p"
kzz = "1e6*p"
[[bearing]]
between = ["inner node 4", "outer node 1"]
kxx = "1e7/p"
cxx = 100
)";

Path straight_path(const Model& model, double p, double slope) {
  Path path;
  path.parameters = VectorSeries::Zero(1, 2);
  path.parameters << p, slope;
  path.x = Vector::Zero(model.n_coordinates());
  return path;
}

Linearization linearization(const Model& model, double p, int order) {
  Linearization result;
  EvaluationCounts counts = model.new_counts();
  EXPECT_FALSE(model.linearize(straight_path(model, p, 1.0), order, result, counts));
  return result;
}

Matrix at_distance(const std::vector<SystemMatrix>& series, double h) {
  Matrix sum = Matrix::Zero(series[0].rows(), series[0].cols());
  double power = 1.0;
  for (const SystemMatrix& one : series) {
    sum += power * one.dense();
    power *= h;
  }
  return sum;
}

TEST(Rotor, SeriesMeetTheMatricesFurtherAlongThePathByTheirOrder) {
  const Setting setting = make_setting(everything);
  const Linearization here = linearization(*setting.model, 0.7, 3);
  const auto error = [&](const auto& member, double h) {
    const Matrix exact = (linearization(*setting.model, 0.7 + h, 0).*member)[0].dense();
    return (at_distance(here.*member, h) - exact).norm() / exact.norm();
  };
  for (const auto member : {&Linearization::M, &Linearization::C, &Linearization::K}) {
    const double order = std::log2(error(member, 0.04) / error(member, 0.02));
    EXPECT_GT(order, 3.7);
  }
}

TEST(Rotor, DoubleMeetsExtendedPrecision) {
  const Setting setting = make_setting(everything);
  const Linearization here = linearization(*setting.model, 0.7, 0);
  BasicLinearization<Extended> exact;
  BasicPath<Extended> path;
  path.parameters = straight_path(*setting.model, 0.7, 0.0).parameters.cast<Extended>();
  path.x = Vector::Zero(setting.model->n_coordinates()).cast<Extended>();
  ASSERT_FALSE(setting.model->extended_linearization(path, exact));
  const auto difference = [](const SystemMatrix& a, const auto& b) {
    return (a.dense() - b.dense().template cast<double>()).norm() / a.dense().norm();
  };
  EXPECT_LT(difference(here.M[0], exact.M[0]), 1e-14);
  EXPECT_LT(difference(here.C[0], exact.C[0]), 1e-14);
  EXPECT_LT(difference(here.K[0], exact.K[0]), 1e-14);
}

TEST(Rotor, FreedomsHaveTheNamesOfTheirNodes) {
  const Setting setting = make_setting(everything);
  const auto& names = setting.model->description().coordinate_names;
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_TRUE(has("inner node 1: x"));
  EXPECT_TRUE(has("inner node 4: rz"));
  EXPECT_TRUE(has("outer node 3: rx"));
  EXPECT_FALSE(has("outer node 3: x"));  // held
  EXPECT_FALSE(has("outer node 1: z"));  // not asked for
  EXPECT_TRUE(has("inner element 3: ry"));
  EXPECT_FALSE(has("outer element 1: x"));  // not refined
  EXPECT_EQ(names.size(), 4U * 6U + 3U * 4U + 3U * 4U - 2U);
}

/// A piece of shaft that is free in space, of any section.
std::string free_shaft(const std::string& more = "") {
  return "[trace]\nparameter = \"speed\"\nfrom = 0\nto = 1\n[parameters]\nspeed = 100\n[[shaft]]\n"
         "stations = { length = [0.3, 0.5], outer = [0.05, 0.08], inner = [0, 0.02] }\nelements = 2\n"
         "E = 2e11\nnu = 0.3\ndensity = 7800\nspeed = \"speed\"\naxial = true\ntorsion = true\n" +
         more;
}

/// The motion of a shaft as a rigid body: a displacement of the origin and a rotation about it.
Vector rigid_motion(const Model& model, const Eigen::Vector3d& shift, const Eigen::Vector3d& turn) {
  const ModelDescription& description = model.description();
  const SpinningShaft& shaft = description.shafts.front();
  Vector u(model.n_coordinates());
  for (std::size_t node = 0; node < shaft.places.size(); ++node) {
    const Eigen::Vector3d at = shift + turn.cross(Eigen::Vector3d(0.0, 0.0, shaft.places[node]));
    const auto first = static_cast<Eigen::Index>(6 * node);
    u.segment<6>(first) << at[0], at[1], turn[0], turn[1], at[2], turn[2];
  }
  return u;
}

TEST(Rotor, AFreeShaftMovesAsARigidBodyWithItsMassAndInertia) {
  const Setting setting = make_setting(free_shaft());
  const Linearization here = linearization(*setting.model, 100.0, 0);
  const Matrix M = here.M[0].dense(), K = here.K[0].dense(), C = here.C[0].dense();
  const double pi = std::numbers::pi;
  double mass = 0.0, moment = 0.0, about_x = 0.0, polar = 0.0;
  for (const auto& [from, to, outer, inner] :
       {std::array{0.0, 0.3, 0.05, 0.0}, std::array{0.3, 0.8, 0.08, 0.02}}) {
    const double area = pi / 4.0 * (outer * outer - inner * inner);
    const double second = pi / 64.0 * (std::pow(outer, 4) - std::pow(inner, 4));
    mass += 7800.0 * area * (to - from);
    moment += 7800.0 * area * (to * to - from * from) / 2.0;
    about_x += 7800.0 * (area * (std::pow(to, 3) - std::pow(from, 3)) / 3.0 + second * (to - from));
    polar += 7800.0 * 2.0 * second * (to - from);
  }
  const auto motion = [&](Eigen::Vector3d shift, Eigen::Vector3d turn) {
    return rigid_motion(*setting.model, shift, turn);
  };
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), none(0, 0, 0);
  const std::vector<Vector> all{motion(x, none), motion(y, none), motion(z, none),
                                motion(none, x), motion(none, y), motion(none, z)};
  for (const Vector& u : all) EXPECT_LT((K * u).norm(), 1e-9 * K.norm() * u.norm());
  const auto product = [&](std::size_t i, std::size_t j) { return all[i].dot(M * all[j]); };
  const double close = 1e-12;
  for (const std::size_t i : {0U, 1U, 2U}) EXPECT_NEAR(product(i, i), mass, close * mass);
  EXPECT_NEAR(product(3, 3), about_x, close * about_x);
  EXPECT_NEAR(product(4, 4), about_x, close * about_x);
  EXPECT_NEAR(product(5, 5), polar, close * polar);
  EXPECT_NEAR(product(0, 4), moment, close * moment);   // ry moves the shaft along x
  EXPECT_NEAR(product(1, 3), -moment, close * moment);  // rx moves it along -y
  // The angular momentum about z is carried along: the moment about x is speed Ip times the rate about y.
  EXPECT_NEAR(all[3].dot(C * all[4]), 100.0 * polar, close * 100.0 * polar);
  EXPECT_TRUE(C.isApprox(-C.transpose(), 0.0));
}

TEST(Rotor, StiffnessIsExactForForcesAtTheEnds) {
  // A cantilever of one element or ten under a force at its end: F l^3 / (3 E I) + F l / (k G A).
  for (const auto& [elements, more] :
       {std::pair(1, ""), std::pair(10, ""), std::pair(10, "refined = true\n")}) {
    for (const double length : {0.02, 2.0}) {
      const Setting setting = make_setting(
          "[trace]\nparameter = \"speed\"\nfrom = 0\nto = 1\n[parameters]\nspeed = 0\n[[shaft]]\n"
          "stations = { length = " +
          std::to_string(length) + ", outer = 0.05, inner = 0.03 }\nelements = " + std::to_string(elements) +
          "\nE = 2e11\nnu = 0.3\ndensity = 7800\nspeed = \"speed\"\n" + more +
          "[[support]]\nnode = 1\nholds = [\"x\", \"y\", \"rx\", \"ry\"]\n");
      const Matrix K = linearization(*setting.model, 0.0, 0).K[0].dense();
      Vector force = Vector::Zero(K.rows());
      force[K.rows() - 4] = 1.0;
      const double moved = K.ldlt().solve(force)[K.rows() - 4];
      const double pi = std::numbers::pi, m2 = 0.36;
      const double k = 6.0 * 1.3 * (1 + m2) * (1 + m2) / (8.8 * (1 + m2) * (1 + m2) + 23.6 * m2);
      const double A = pi / 4.0 * (0.05 * 0.05 - 0.03 * 0.03);
      const double I = pi / 64.0 * (std::pow(0.05, 4) - std::pow(0.03, 4));
      const double G = 2e11 / 2.6;
      const double expected = std::pow(length, 3) / (3.0 * 2e11 * I) + length / (k * G * A);
      EXPECT_NEAR(moved, expected, 1e-9 * expected) << elements << " elements, " << length << " m";
    }
  }
}

TEST(Rotor, ADiscByItsShapeIsThatByItsNumbers) {
  const double pi = std::numbers::pi, mass = 7800.0 * pi / 4.0 * (0.09 - 0.01) * 0.05;
  const double polar = mass * (0.09 + 0.01) / 8.0, diametral = polar / 2.0 + mass * 0.0025 / 12.0;
  const auto text = [](double x) { return exact_text(x); };
  const Setting shape = make_setting(
      free_shaft("[[disc]]\nnode = 2\nouter = 0.3\ninner = 0.1\nwidth = 0.05\ndensity = 7800\n"));
  const Setting numbers =
      make_setting(free_shaft("[[disc]]\nnode = 2\nmass = " + text(mass) + "\nId = " + text(diametral) +
                              "\nIp = " + text(polar) + "\n"));
  const Linearization a = linearization(*shape.model, 100.0, 0), b = linearization(*numbers.model, 100.0, 0);
  EXPECT_LT((a.M[0].dense() - b.M[0].dense()).norm(), 1e-14 * a.M[0].dense().norm());
  EXPECT_LT((a.C[0].dense() - b.C[0].dense()).norm(), 1e-14 * a.C[0].dense().norm());
}

class RotorFiles : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() + "/" + name) << text;
  }
  Setting setting(const std::string& text) const {
    write("scene.toml", text);
    Setting result;
    static_cast<TraceSetup&>(result) = prepare_trace(read_scene(folder_.path() + "/scene.toml"), {});
    return result;
  }
  Folder folder_;
};

TEST_F(RotorFiles, StationsOfAFileAreThoseOfTheScene) {
  const std::string rest = "E = 2e11\nnu = 0.3\ndensity = 7800\nspeed = \"speed\"\n";
  const std::string head =
      "[trace]\nparameter = \"speed\"\nfrom = 0\nto = 1\n[parameters]\nspeed = 0\n[[shaft]]\n";
  const Setting scene = setting(
      head +
      "stations = { length = [0.3, 0.5], outer = [0.05, 0.08], inner = [0, 0.02] }\nelements = [2, 3]\n" +
      rest);
  write("lengths.csv",
        "# a shaft\nlength [mm], outer [mm], inner [mm], elements\n300, 50, 0, 2\n500, 80, 20, 3\n");
  write("positions.csv", "position;outer;inner;elements\n0;0.05;0;2\n0.3;0.08;0.02;3\n0.8;0;0;0\n");
  const Matrix K = linearization(*scene.model, 0.0, 0).K[0].dense();
  for (const char* file : {"lengths.csv", "positions.csv"}) {
    const Setting other = setting(head + "stations = \"" + file + "\"\n" + rest);
    const Matrix of_file = linearization(*other.model, 0.0, 0).K[0].dense();
    ASSERT_EQ(of_file.rows(), K.rows()) << file;
    EXPECT_LT((of_file - K).norm(), 1e-13 * K.norm()) << file;
  }
}

/// Coefficients in closed form, sampled at 15 speeds.
TEST_F(RotorFiles, TablesOfBearingsAreInterpolatedAndTheirErrorIsStated) {
  const auto stiffness = [](double rpm) { return 1e7 * (1.0 + 0.3 * std::tanh((rpm - 3000.0) / 2000.0)); };
  const auto damping = [](double rpm) { return 1e4 / (1.0 + rpm / 2000.0); };
  std::string table = "speed [rpm], kxx [kN/m], cxx [N s/m]\n";
  for (int i = 0; i < 15; ++i) {
    const double rpm = 400.0 * i;
    table += exact_text(rpm) + "," + exact_text(stiffness(rpm) / 1e3) + "," + exact_text(damping(rpm)) + "\n";
  }
  write("bearing.csv", table);
  const std::string scene =
      "[trace]\nparameter = \"speed\"\nfrom = 0\nto = 5600\n[parameters]\nspeed = { value = 0, unit = "
      "\"rpm\" }\n"
      "[[shaft]]\nstations = { length = 0.3, outer = 0.05 }\nE = 2e11\nnu = 0.3\ndensity = 7800\n"
      "speed = \"speed\"\n[[bearing]]\nnode = 1\n";
  const Setting sampled = setting(scene + "table = \"bearing.csv\"\n");
  const Setting none = setting(scene + "kxx = 0\n");
  double worst_k = 0.0, worst_c = 0.0;
  for (double rpm = 0.0; rpm <= 5600.0; rpm += 37.0) {
    const Linearization with = linearization(*sampled.model, rpm, 0),
                        without = linearization(*none.model, rpm, 0);
    const Matrix K = with.K[0].dense() - without.K[0].dense(), C = with.C[0].dense() - without.C[0].dense();
    EXPECT_NEAR(K(0, 0), K(1, 1), 1e-6 * std::abs(K(0, 0)));  // kyy is kxx; rounding of the shaft's stiffness
    worst_k = std::max(worst_k, std::abs(K(0, 0) - stiffness(rpm)) / 1.3e7);
    worst_c = std::max(worst_c, std::abs(C(0, 0) - damping(rpm)) / 1e4);
  }
  std::string stated;
  for (const auto& [label, text] : sampled.model->description().data)
    if (label == "bearing 1") stated = text;
  const std::size_t at = stated.find("missed by ");
  ASSERT_NE(at, std::string::npos) << stated;
  const double bound = std::stod(stated.substr(at + 10));
  EXPECT_LT(std::max(worst_k, worst_c), bound) << stated;
  EXPECT_LT(bound, 1e-2);
  // Series through the table, by their order.
  const Linearization here = linearization(*sampled.model, 1700.0, 3);
  const auto error = [&](double h) {
    const Matrix exact = linearization(*sampled.model, 1700.0 + h, 0).K[0].dense();
    return (at_distance(here.K, h) - exact).norm();
  };
  EXPECT_GT(std::log2(error(100.0) / error(50.0)), 3.5);
}

}  // namespace
}  // namespace eigentrail::test::rotor_test
