// Uniform gravity on all masses: f = m g on the origin, and m c_i g on the directors of a body.
#pragma once

#include "model/elements/mass_distribution.hpp"

namespace eigentrail {

struct Gravity {
  static constexpr std::string_view name = "gravity";
  static constexpr std::string_view description = "uniform gravity on every mass";
  static constexpr Contribution contribution{.conservative = true};

  MassDistribution masses;
  std::array<Quantity, 3> acceleration;

  static void fields(auto& self, auto& visit) {
    MassDistribution::fields(self.masses, visit);
    visit.numbers(self.acceleration);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> g = at.value(acceleration);
    for (int i = 0; i < masses.size; ++i) {
      if (masses.moment(i, 0).slot < 0) continue;
      at.add_force(masses.carriers[static_cast<std::size_t>(i)], at.value(masses.moment(i, 0)) * g);
    }
  }
};

}  // namespace eigentrail
