// C04 to C07: pendulums and a truss, from closed forms of their equilibria.
#include <cmath>
#include <sstream>

#include "hard_cases/family.hpp"
#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

WideComplexMatrix scalar(WideComplex value) {
  return WideComplexMatrix::Constant(1, 1, value);
}

/// One undamped degree of freedom of unit mass.
WidePencil oscillator(WideComplex stiffness) {
  return {scalar(1), scalar(0), scalar(stiffness)};
}

HardCase named(const std::string& name, const std::string& derivation, double from, double to) {
  HardCase result;
  result.name = name;
  result.source = derivation;
  result.from = from;
  result.to = to;
  return result;
}

std::string range(const std::string& parameter, double from, double to) {
  std::ostringstream text;
  text.precision(17);
  text << "[trace]\nparameter = \"" << parameter << "\"\nfrom = " << from << "\nto = " << to << "\n\n";
  return text.str();
}

// The spring pendulum of the seed paper, Sect. 6.2.
constexpr double gravity = 9.81, bob_mass = 2.0, rod_length = 1.5;
const Wide weight_stiffness = Wide(bob_mass) * gravity / rod_length;  // m g / l

/// Branch 0 is tilted, sin(theta) = m g / (k l), s^2 = -(k / m) cos^2(theta) (Eq. 119); branch 1 hangs
/// straight, s^2 = -(m g / l - k) / m.
WideComplex spring_pendulum_stiffness(WideComplex k, int branch) {
  if (branch == 1) return (weight_stiffness - k) / Wide(bob_mass);
  return (k - weight_stiffness) * (k + weight_stiffness) / (k * Wide(bob_mass));
}

const char* const spring_pendulum_elements =
    "[gravity]\nacceleration = [0, 0, \"-g\"]\n\n"
    "[[point]]\nname = \"bob\"\nmass = \"mass\"\nposition = [\"0.8 * length\", 0, \"-0.6 * length\"]\n\n"
    "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = \"length\"\n\n"
    "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n\n"
    "[[guided_spring]]\npoint = \"bob\"\ndirection = [0, 0, 1]\nstiffness = \"k\"\n";

HardCase spring_pendulum(const std::string& name, const std::string& to, double factor) {
  const auto critical = static_cast<double>(weight_stiffness);
  HardCase result =
      named(name, "seed paper, Sect. 6.2, Eqs. (119), (120)", 2.0 * critical, factor * critical);
  result.scene =
      "[parameters]\ng = 9.81\nmass = 2.0\nlength = 1.5\nk = 26.16\n\n[trace]\nparameter = \"k\"\n"
      "from = \"2 * mass * g / length\"\nto = \"" +
      to + "\"\n\n" + spring_pendulum_elements;
  result.pencil = [](WideComplex k, int branch) { return oscillator(spring_pendulum_stiffness(k, branch)); };
  result.spectrum = [critical](double k) {
    Spectra spectra(2);
    if (k >= critical) spectra[0] = undamped_pairs({spring_pendulum_stiffness(k, 0)});
    spectra[1] = undamped_pairs({spring_pendulum_stiffness(k, 1)});
    return spectra;
  };
  result.special = {{"branch_point", critical, 0.0}};
  return result;
}

/// Pendulum of unit length and mass pushed along its circle with p times its weight: sin(angle) = p,
/// s^2 = -g cos(angle); branch 0 hangs, branch 1 stands.
HardCase pushed_pendulum() {
  HardCase result = named("C05_pushed_pendulum", own_closed_form, 0.0, 1.2);
  result.scene = "[parameters]\ng = 9.81\np = 0.0\n\n" + range("p", 0.0, 1.2) +
                 "[gravity]\nacceleration = [0, 0, \"-g\"]\n\n"
                 "[[point]]\nname = \"bob\"\nmass = 1.0\nposition = [0, 0, -1]\n\n"
                 "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = 1.0\n\n"
                 "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n\n"
                 "[[follower_force]]\npoint = \"bob\"\nfrom = [0, 0, 0]\nto = \"bob\"\nmagnitude = \"p*g\"\n"
                 "angle = \"-pi/2\"\naxis = [0, 1, 0]\n";
  const auto stiffness = [](WideComplex p, int branch) {
    return (branch == 0 ? Wide(gravity) : -Wide(gravity)) * std::sqrt((Wide(1) - p) * (Wide(1) + p));
  };
  result.pencil = [stiffness](WideComplex p, int branch) { return oscillator(stiffness(p, branch)); };
  result.spectrum = [stiffness](double p) -> Spectra {
    if (p > 1.0) return {{}, {}};
    return {undamped_pairs({stiffness(p, 0)}), undamped_pairs({stiffness(p, 1)})};
  };
  result.special = {{"fold", 1.0, 0.0}};
  return result;
}

// Von Mises truss: springs of unit stiffness from (-1, 0) and (1, 0) to an apex of unit mass at height w,
// without force at w = 0.2. The load is P = 2 w (L0 / L - 1) with L^2 = 1 + w^2, L0^2 = 1.04; dP/dw = 0 at
// L^3 = L0.
const Wide free_length = std::sqrt(Wide(1.04));
const Wide limit_height = std::sqrt(std::cbrt(free_length) * std::cbrt(free_length) - 1);

Wide truss_load(Wide w) {
  return 2 * w * (free_length / std::hypot(Wide(1), w) - 1);
}

/// The height at a load: branch 0 above the limit height, 1 between the limits, 2 below. Clamped to the
/// branch.
Wide truss_height(Wide load, int branch) {
  const Wide ends[][2] = {{limit_height, 2}, {-limit_height, limit_height}, {-2, -limit_height}};
  Wide a = ends[branch][0];
  Wide b = ends[branch][1];
  const Wide slope = branch == 1 ? 1 : -1;
  for (int i = 0; i < 200; ++i) {
    const Wide middle = (a + b) / 2;
    if (middle == a || middle == b) break;
    (slope * (truss_load(middle) - load) < 0 ? a : b) = middle;
  }
  return (a + b) / 2;
}

WidePencil truss_pencil(Wide load, int branch) {
  const Wide w = truss_height(load, branch);
  const Wide squared = 1 + w * w;
  const Wide tension = 1 - free_length / std::sqrt(squared);
  WidePencil pencil;
  pencil.M = WideComplexMatrix::Identity(2, 2);
  pencil.C = WideComplexMatrix::Zero(2, 2);
  pencil.K = WideComplexMatrix::Zero(2, 2);
  pencil.K(0, 0) = 2 * (1 + tension * w * w) / squared;
  pencil.K(1, 1) = 2 * (w * w + tension) / squared;
  return pencil;
}

/// Snaps through at the limit load and back at its negative: the path turns twice before it ends at `to`.
HardCase truss() {
  constexpr double limit = 0.0030191474033251500073;
  HardCase result =
      named("C06_von_mises_truss", "von Mises 1923 (Z. angew. Math. Mech. 3), closed form", -0.004, 0.004);
  result.scene =
      "[parameters]\nload = 0.0\n\n" + range("load", -0.004, 0.004) +
      "[[point]]\nname = \"apex\"\nmass = 1.0\nposition = [0, 0, 0.2]\n\n"
      "[[spring]]\nfrom = [-1, 0, 0]\nto = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(1.04)\"\n\n"
      "[[spring]]\nfrom = [1, 0, 0]\nto = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(1.04)\"\n\n"
      "[[force]]\npoint = \"apex\"\ncomponents = [0, 0, \"-load\"]\n\n"
      "[[plane]]\npoint = \"apex\"\nnormal = [0, 1, 0]\n";
  result.pencil = [](WideComplex load, int branch) { return truss_pencil(load.real(), branch); };
  result.spectrum = [](double load) {
    Spectra spectra(3);
    const bool exists[] = {load <= limit, std::abs(load) <= limit, load >= -limit};
    for (int branch = 0; branch < 3; ++branch) {
      if (!exists[branch]) continue;
      const WidePencil pencil = truss_pencil(load, branch);
      spectra[static_cast<std::size_t>(branch)] = undamped_pairs({pencil.K(0, 0), pencil.K(1, 1)});
    }
    return spectra;
  };
  result.special = {{"fold", limit, 0.0, 0.0, 0}, {"fold", -limit, 0.0, 0.0, 1}};
  return result;
}

/// The plane pendulum, length 0.5 to 5: s = j sqrt(g / length), however its constraints are written.
HardCase pendulum(const std::string& name, const std::string& parameters, const std::string& constraints) {
  HardCase result = named(name, "seed paper, Sect. 6.1, Eq. (76)", 0.5, 5.0);
  result.scene = "[parameters]\ng = 9.81\nlength = 1.5\n" + parameters + "\n" + range("length", 0.5, 5.0) +
                 "[gravity]\nacceleration = [0, 0, \"-g\"]\n\n"
                 "[[point]]\nname = \"bob\"\nmass = 2.0\nposition = [0, 0, \"-length\"]\n\n"
                 "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = \"length\"\n\n" +
                 constraints;
  result.pencil = [](WideComplex length, int) { return oscillator(Wide(gravity) / length); };
  result.spectrum = [](double length) -> Spectra { return {undamped_pairs({Wide(gravity) / length})}; };
  result.has_branches = true;
  result.branches = {[](double length) { return Complex(0.0, std::sqrt(gravity / length)); }};
  return result;
}

/// A second rod from a place beside the plane, `aside` at length 1: the rods' normals are parallel but for
/// this angle, and together they keep the bob in the plane.
HardCase pendulum_with_second_rod(const std::string& name, const std::string& aside) {
  return pendulum(
      name, "aside = " + aside + "\n",
      "[[rod]]\nfrom = [0, \"aside*length\", 0]\nto = \"bob\"\nlength = \"length*sqrt(1 + aside^2)\"\n");
}

}  // namespace

std::vector<HardCase> constrained_cases() {
  const std::string in_plane = "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n";
  return {spring_pendulum("C04_spring_pendulum_to_pitchfork", "mass * g / length", 1.0),
          spring_pendulum("C04_spring_pendulum_beyond_pitchfork", "0.5 * mass * g / length", 0.5),
          pushed_pendulum(),
          truss(),
          pendulum("C07_rod_twice", "",
                   "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = \"length\"\n\n" + in_plane),
          pendulum_with_second_rod("C07_second_rod_1em2", "1e-2"),
          pendulum_with_second_rod("C07_second_rod_1em4", "1e-4"),
          pendulum_with_second_rod("C07_second_rod_1em6", "1e-6"),
          pendulum_with_second_rod("C07_second_rod_1em8", "1e-8"),
          pendulum_with_second_rod("C07_second_rod_1em10", "1e-10")};
}

}  // namespace eigentrail::test
