#include "bench/families.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "hard_cases/family.hpp"

namespace eigentrail::test {
namespace {

constexpr double lowest_frequency = 3.0;  ///< rad/s
constexpr double movement = 1.5;   ///< standard deviation of the stiffness that moves single modes, 1/s^2
constexpr double coupling = 0.06;  ///< of the stiffness that couples two modes, 1/s^2
constexpr double whirl = 0.02;     ///< of the gyroscopic coupling, 1/s
constexpr double damping = 0.02;   ///< 1/s

using Normal = std::normal_distribution<double>;

Matrix symmetric_change(int n, std::mt19937_64& engine) {
  Normal normal;
  Matrix K = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    // Bounded, so that the stiffness stays positive.
    K(i, i) = movement * std::clamp(normal(engine), -2.0, 2.0);
    for (int j = 0; j < i; ++j) K(i, j) = K(j, i) = coupling * normal(engine);
  }
  return K;
}

Matrix skew_symmetric(int n, std::mt19937_64& engine) {
  Normal normal;
  Matrix G = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      G(i, j) = whirl * normal(engine);
      G(j, i) = -G(i, j);
    }
  }
  return G;
}

Family undamped(int n, double spacing, std::mt19937_64& engine) {
  const Vector frequencies =
      Vector::LinSpaced(n, lowest_frequency, lowest_frequency + spacing * (n - 1)).cwiseAbs2();
  return {{Matrix::Identity(n, n)}, {}, {Matrix(frequencies.asDiagonal()), symmetric_change(n, engine)}};
}

Setting setting_of(const Family& family, const OptionTexts& overrides) {
  return make_setting(family_case("benchmark", "", 0.0, 1.0, family, {}).scene, overrides);
}

constexpr const char* chain_effects =
    "[[spring]]\nfrom = [2, 0, -1]\nto = \"p2\"\nstiffness = 20\nfree_length = 1\n"
    "[[guided_spring]]\npoint = \"p3\"\ndirection = [1, 0, 0]\nstiffness = 5\n"
    "[[drag]]\npoint = \"p1\"\ncoefficient = 0.1\n[[drag]]\npoint = \"p4\"\ncoefficient = 0.2\n"
    "[[force]]\npoint = \"p4\"\ncomponents = [2, 0, 0]\n"
    "[[follower_force]]\npoint = \"p4\"\nfrom = \"p3\"\nto = \"p4\"\nmagnitude = 3\n";

std::string chain(int points) {
  std::string text =
      "[parameters]\nlength = 1.0\n[trace]\nparameter = \"length\"\nfrom = 1.0\nto = 1.5\n"
      "[gravity]\nacceleration = [0, 0, -9.81]\n";
  std::string above = "[0, 0, 0]";
  for (int i = 1; i <= points; ++i) {
    const std::string name = "\"p" + std::to_string(i) + "\"";
    text += "[[point]]\nname = " + name + "\nmass = " + std::to_string(i) + "\nposition = [0.1, 0, -" +
            std::to_string(i) + "]\n[[fixed]]\npoint = " + name +
            "\ncoordinate = \"y\"\n[[rod]]\nfrom = " + above + "\nto = " + name +
            "\nlength = " + (i == 1 ? "\"length\"" : "1.0") + "\n";
    above = name;
  }
  return text;
}

}  // namespace

Setting gyroscopic_family(int n, unsigned seed, const OptionTexts& overrides, double spacing) {
  std::mt19937_64 engine(seed);
  Family family = undamped(n, spacing, engine);
  family.C = {damping * Matrix::Identity(n, n), skew_symmetric(n, engine)};
  return setting_of(family, overrides);
}

Setting undamped_family(int n, unsigned seed, const OptionTexts& overrides) {
  std::mt19937_64 engine(seed);
  return setting_of(undamped(n, close, engine), overrides);
}

Setting hanging_chain() {
  return make_setting(chain(4) + chain_effects);
}

}  // namespace eigentrail::test
