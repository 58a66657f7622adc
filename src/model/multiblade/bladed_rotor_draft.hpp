// What a scene says of a rotor of equal blades: [rotor].
#pragma once

#include <vector>

#include "eigentrail/core/errors.hpp"

namespace eigentrail {

struct BladedRotorDraft {
  int blades = 0;
  int hub = 0;               ///< index of Draft::bodies
  std::vector<bool> stands;  ///< by triple: of the support or the hub, in the frame that stands
  /// Of the velocities of inflows, whose triples follow: 1 if the axis is that of rotation, -1 if it is
  /// opposite.
  std::vector<int> inflows;
  SourceLocation where;
};

}  // namespace eigentrail
