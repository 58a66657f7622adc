// Where the coordinates of one blade and of the support are among those of a rotor of N blades.
//
// A *part* of the rotor is described over the coordinates of the scene: those of one blade, in the frame that
// turns with it, of the hub, and of the support, in the frame that stands. Let z_k be these coordinates as
// blade k sees them and w those of the rotor: of the support with the hub, and the multiblade coordinates of
// the blades. Then
//
//   z_k = G(psi_k) w,   G(psi) = sum_a phi_a(psi) G_a (harmonics.hpp)
//
// with constant matrices G_a. For a coordinate of a blade, G_a has a one in the column of its multiblade
// coordinate a. For the hub, G is the turn of its body. With its origin q0 and axes d1, d2, d3 in the frame
// that stands, and R(psi) the turn about z, the body that turns with the rotor is seen from blade k at
//
//   R^T q0,   R^T (cos(psi) d1 + sin(psi) d2),   R^T (-sin(psi) d1 + cos(psi) d2),   R^T d3.
//
// This has the harmonics 0, 1 and 2. The second harmonic vanishes for all displacements that leave the axes
// at right angles and of unit length, which are those that the constraints of the hub permit; G leaves it
// out. What remains is a first harmonic at most, and so sums over N >= 3 blades of products of two of them
// are constant.
//
// The inflow v_0 + v_x x / R + v_y y / R is one of the rotor as a whole, with axes x, y that stand. A blade
// sees v_0, and (v_x, v_y) turned by -psi about the axis of rotation.
#pragma once

#include <cstddef>
#include <vector>

namespace eigentrail {

/// A coordinate of the rotor and its weight.
struct RotorShare {
  int coordinate = 0;
  double weight = 1.0;
};

/// Velocity of an inflow: its first coordinate among those of the scene, and the sense in which its axes x, y
/// turn about the axis of rotation.
struct InflowCoordinates {
  int first = 0;
  int sense = 1;
};

/// G_a: the entries in the row of each coordinate of the scene.
using RotorShares = std::vector<std::vector<RotorShare>>;

struct MultibladeMap {
  int n_coordinates = 0;  ///< of the rotor
  int n_constraints = 0;
  std::vector<int> support;  ///< by coordinate of the scene: that of the rotor; -1 for those of a blade
  /// By coordinate of the scene: that of the rotor which is its collective part, the other harmonics follow
  /// at distances of `stride`; -1 for the support.
  std::vector<int> blade;
  std::vector<int> stride;
  int hub_coordinate = 0;  ///< of the scene: the first one of the hub's twelve
  std::vector<InflowCoordinates> inflows = {};

  /// Of one blade and the hub as it sees it.
  RotorShares blade_shares(std::size_t harmonic) const;
  /// Of the support, which is the same for all azimuths.
  RotorShares support_shares() const;
};

}  // namespace eigentrail
