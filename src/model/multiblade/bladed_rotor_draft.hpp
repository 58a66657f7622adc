// What a scene says of a rotor of equal blades: [rotor].
#pragma once

#include <vector>

#include "eigentrail/core/errors.hpp"

namespace eigentrail {

struct BladedRotorDraft {
  int blades = 0;
  int hub = 0;               ///< index of Draft::bodies
  std::vector<bool> stands;  ///< by triple: of the support or the hub, in the frame that stands
  SourceLocation where;
};

}  // namespace eigentrail
