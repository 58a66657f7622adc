// Inertia of points and of rigid bodies (seed paper, Eq. 140, for points).
#pragma once

#include "model/elements/mass_distribution.hpp"

namespace eigentrail {

/// Point mass: inertia force -m a.
struct PointMass {
  static constexpr std::string_view name = "point";
  static constexpr std::string_view description = "a point with mass: inertia force -m a";
  static constexpr Contribution contribution{.inertia = true};

  MassDistribution masses;

  static void fields(auto& self, auto& visit) { MassDistribution::fields(self.masses, visit); }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    masses.add_inertia_forces(at, [&](const Place& carrier) { return at.acceleration(carrier); });
  }
};

/// Rigid body: the same for its origin and directors.
struct RigidBody : PointMass {
  static constexpr std::string_view name = "body";
  static constexpr std::string_view description =
      "a rigid body: constant mass matrix of its origin and directors";
};

}  // namespace eigentrail
