// A candidate for a block with a given track.
#pragma once

#include <cstddef>

namespace eigentrail {

/// Eigenvalues that are joined because they are close, and not because they are seen to meet, stay together
/// up to this multiple of their distance. With a smaller one they are joined again soon; a larger one keeps
/// blocks, which cost more than single modes.
inline constexpr double kept_together = 3.0;

/// A candidate for a block with a given track: another track, or the track's own conjugate.
struct Partner {
  bool conjugate = false;  ///< the own conjugate; `track` is then the track itself
  std::size_t track = 0;   ///< index of the other track
  double distance = 0.0;   ///< of their nearest meeting from the step, in the coordinate along the path
};

}  // namespace eigentrail
