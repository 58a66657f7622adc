// Who could be followed together with a track.
#pragma once

#include <cstddef>

namespace eigentrail {

/// Who could be followed together with a track: another track, or its own conjugate.
struct Partner {
  bool conjugate = false;
  std::size_t track = 0;
  double distance = 0.0;  ///< of the meeting from the step
};

}  // namespace eigentrail
