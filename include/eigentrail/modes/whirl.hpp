// Whirl: whether what spins moves round its axis in the sense of its spin or against it, in a mode.
//
// A node with the displacement Re((X, Y) e^(i w t)) across the axis moves on an ellipse. With the forward and
// backward parts F = (X + i Y)/2 and B = (X - i Y)/2 its semi-axes are |F| + |B| and |F| - |B|; the second is
// negative where it goes round backward.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// The orbits of a mode, relative to the sense of the spin.
struct Whirl {
  /// Areas of the ellipses over the areas of the circles about them, summed over the nodes: 1 if all go round
  /// on circles forward, -1 if backward, 0 on lines. NaN if nothing spins, or nothing moves across the axis.
  double measure = std::numeric_limits<double>::quiet_NaN();
  /// The smaller one of the shares of both senses: 0 if all nodes go round in one sense, at most 1/2.
  double reverse = std::numeric_limits<double>::quiet_NaN();
};

/// Whether the model has something that spins: shafts, or discs on axes of bodies.
bool has_whirl(const ModelDescription& description);

/// The whirl of a mode. Shafts: the orbits of their nodes, in the sense of the first shaft that spins. Discs
/// on bodies: those of the bodies' centres and of the tips of their axes, about the axes of the starting
/// guess; the larger of both measures counts. `parameters`: declared units; `shape`: coordinates of the
/// model, of the eigenvalue with Im s > 0.
Whirl whirl_of(const Model& model, const Vector& parameters, const ComplexVector& shape);

/// "forward", "backward", "mixed" if nodes differ, or "" where nothing is clear: orbits that are nearly
/// lines.
std::string whirl_in_words(const Whirl& whirl);

/// Displacements x and y of each node; zero where it is held. `shape`: coordinates of the model, also of one
/// that is the projection of a rotor.
std::vector<std::array<Complex, 2>> displacements(const Model& model, const SpinningShaft& shaft,
                                                  const ComplexVector& shape);

}  // namespace eigentrail
