// A candidate for a block with a given track.
#pragma once

#include <cstddef>

namespace eigentrail {

/// A candidate for a block with a given track: another track, or the track's own conjugate.
struct Partner {
  bool conjugate = false;  ///< the own conjugate; `track` is then the track itself
  std::size_t track = 0;   ///< index of the other track
  double distance = 0.0;   ///< of their nearest meeting from the step, in the coordinate along the path
};

}  // namespace eigentrail
