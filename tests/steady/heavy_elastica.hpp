// A beam that bends far under its weight: as a scene, and as the heavy elastica.
#pragma once

#include <cmath>
#include <string>

#include "eigentrail/steady/equilibrium.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

/// Tip of an inextensible cantilever of length 1 and EI = 1 under its weight w: the heavy elastica EI t'' =
/// -w (1 - s) cos t with t(0) = 0 and t'(1) = 0, by shooting with the classical Runge-Kutta method.
inline Vector heavy_elastica(double w) {
  const auto shoot = [w](double curvature, Vector& tip) {
    constexpr int steps = 2000;
    const double h = 1.0 / steps;
    const auto slope = [w](double s, const Vector& y) {
      return Vector{{y[1], -w * (1.0 - s) * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])}};
    };
    Vector y{{0.0, curvature, 0.0, 0.0}};
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const Vector a = slope(s, y), b = slope(s + 0.5 * h, y + 0.5 * h * a);
      const Vector c = slope(s + 0.5 * h, y + 0.5 * h * b), d = slope(s + h, y + h * c);
      y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    tip = y.tail(2);
    return y[1];
  };
  // The least curvature at the root belongs to the beam that does not wind up.
  Vector tip;
  double low = 0.0, high = 0.01 * w;
  while (shoot(high, tip) < 0.0) {
    low = high;
    high += 0.01 * w;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle, tip) < 0.0 ? low : high) = middle;
  }
  return tip;
}

/// The cantilever of the scenes at rest, straight in the guess, under a weight per length; EI and length are
/// one. `elements`: the line of the scene that says how many there are.
struct HeavyCantilever {
  Setting setting;
  Equilibrium found;

  HeavyCantilever(double weight, const std::string& elements)
      : setting(scene_setting("rotating_cantilever", {},
                              {{"elements     = 10", elements},
                               {"lag     = 20.0", "lag = 20.0\nweight = " + std::to_string(weight)},
                               {"[[beam]] ", "[gravity]\nacceleration = [0, 0, \"-weight\"]\n[[beam]] "}})),
        found(at_rest(setting)) {}

  /// Position of the last node.
  Vector tip() const { return found.x.segment(setting.model->n_coordinates() - 12, 3); }
};

}  // namespace eigentrail::test
