// What moves in a mode, in the words of the field, from the names of coordinates or states.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A motion and its share in a mode.
struct MotionShare {
  std::string name;
  double share = 0.0;
};

/// The motions of a mode, by descending share. `names`: of n coordinates or states; `shares`: n, adding up to
/// one; `shape`: n, of the eigenvalue with Im s >= 0, for motions as exp(s t).
///
/// * "X velocity" and "X rate" are parts of the motion X, if there is one.
/// * "X cosine" and "X sine" are multiblade coordinates, q_k = c cos(psi_k) + s sin(psi_k), of which |c + i
/// s|
///   belongs to a wave that turns with the rotor, "X progressive", and |c - i s| to one that turns against
///   it, "X regressive" (Johnson, Helicopter Theory, Sect. 8-4; Bir, NREL/CP-500-42553, 2008). "cosine 2" and
///   "sine 2" likewise. Of real eigenvalues, in which nothing turns, they stay apart.
std::vector<MotionShare> motion_shares(const std::vector<std::string>& names, const Vector& shares,
                                       const ComplexVector& shape);

}  // namespace eigentrail
