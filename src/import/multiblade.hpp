// Multiblade coordinates (Bir, Multiblade coordinate transformation and its application to wind turbine
// analysis, NREL/CP-500-42553, 2008; Coleman). The motions q_k of N >= 3 equal blades are replaced by those
// of the rotor as a whole,
//
//   q_k = a_0 + sum_n (a_n cos(n psi_k) + b_n sin(n psi_k)) + a_d (-1)^k,   psi_k = psi + 2 pi (k - 1) / N,
//
// n = 1 ... below N/2, the last term for even N only. In them the equations of a rotor with equal blades do
// not depend on the azimuth psi.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The same state of all blades, blade 1 first, as indices of states. `rates`: the states that are their time
/// derivatives; empty if there are none (first-order states).
struct BladeStates {
  std::vector<Eigen::Index> states;
  std::vector<Eigen::Index> rates = {};
};

/// T of x = T x_mb, n x n, and its derivative by psi. States that are in no tuple stay as they are.
struct MultibladeTransformation {
  Matrix T, derivative;
};
MultibladeTransformation multiblade(Eigen::Index n, const std::vector<BladeStates>& tuples, double azimuth,
                                    double rotor_speed);

/// T^-1 (A T - rotor_speed T'), which is the A of x_mb.
Matrix in_multiblade_coordinates(const Matrix& A, const MultibladeTransformation& transformation,
                                 double rotor_speed);

}  // namespace eigentrail
