// Mass of a point or of a rigid body. Positions on a body are linear in its origin q0 and its directors q1,
// q2, q3 (unit vectors along its axes), x = q0 + sum a_i q_i, so its kinetic energy is
//
//     T = 1/2 sum_ij G_ij q_i' . q_j',    G_00 = m,  G_0i = m c_i,  G_ij = integral of a_i a_j over the mass
//
// with constant G (natural coordinates: Garcia de Jalon & Bayo 1994; directors: Betsch & Steinmann 2001).
// Inertia forces, also those of a rotating frame, are linear in the coordinates. A point has only G_00.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct MassDistribution {
  int size = 1;                    ///< number of `carriers` in use: 1 for a point, 4 for a body
  std::array<Place, 4> carriers;   ///< position of the point; or origin and directors of the body
  Quantity mass;                   ///< kg; moments without slot are zero
  std::array<Quantity, 3> first;   ///< G_01, G_02, G_03, kg m
  std::array<Quantity, 6> second;  ///< G_11, G_22, G_33, G_12, G_13, G_23, kg m^2

  static void fields(auto& self, auto& visit) {
    for (int i = 0; i < self.size; ++i) visit.place("name", self.carriers[i], "");
    visit.numbers(self.mass);
    if (self.size > 1) visit.numbers(self.first, self.second);
  }

  /// Entry (i, j) of G.
  const Quantity& moment(int i, int j) const {
    if (i == 0 && j == 0) return mass;
    if (i == 0 || j == 0) return first[static_cast<std::size_t>(i + j - 1)];
    return second[static_cast<std::size_t>(i == j ? i - 1 : i + j)];
  }

  /// Adds the forces -sum_j G_ij a_j, where a_j = acceleration(carrier j).
  template <class Scalar, class Acceleration>
  void add_inertia_forces(ElementView<Scalar>& at, Acceleration acceleration) const {
    for (int j = 0; j < size; ++j) {
      const Vec3<Scalar> a = acceleration(carriers[static_cast<std::size_t>(j)]);
      for (int i = 0; i < size; ++i) {
        const Quantity& moment_ij = moment(i, j);
        if (moment_ij.slot < 0) continue;
        at.add_force(carriers[static_cast<std::size_t>(i)], -at.value(moment_ij) * a);
      }
    }
  }
};

}  // namespace eigentrail
