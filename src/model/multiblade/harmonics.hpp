// Multiblade coordinates (Coleman & Feingold, NACA Report 1351, 1958; Johnson, Helicopter Theory, 1980,
// Sect. 8-4). The motions q_k of N >= 3 equal blades at the azimuths psi_k = Omega t + 2 pi k / N are
// replaced by those of the rotor as a whole,
//
//   q_k = sum_a phi_a(psi_k) beta_a,   phi = 1, cos(n psi), sin(n psi) with n = 1 ... below N/2,
//
// and for even N also phi = (-1)^k. The functions are orthogonal over the blades:
// sum_k phi_a phi_b = N w_a delta_ab with w = 1, 1/2, 1/2, ..., 1.
#pragma once

#include <string>
#include <vector>

namespace eigentrail {

/// One of the functions phi. Its derivative by psi is slope times the function with index `partner`.
struct Harmonic {
  std::string name;          ///< "collective", "cosine", "sine 2", "differential"
  int number = 0;            ///< n; 0 for the collective and the differential function
  int partner = -1;          ///< index of the sine of a cosine and the reverse; -1: constant for each blade
  double slope = 0.0;        ///< -n for a cosine, n for a sine
  double mean_square = 1.0;  ///< w
};

/// The functions in the order of multiblade_names.
std::vector<Harmonic> multiblade_harmonics(int n_blades);

/// "collective", "cosine", "sine", "cosine 2", "sine 2", ..., "differential": the order of the coordinates
/// that replace those of N blades.
std::vector<std::string> multiblade_names(int n_blades);

}  // namespace eigentrail
