// How much of the certificate a track gets on a step.
#pragma once

namespace eigentrail {

/// How the certificate of a track is tested.
enum class TrackTest {
  strict,   ///< if it fails, the step is treated as above
  lenient,  ///< if it fails, the track passes by its shape: it failed on the last step, too
  none      ///< the track passes by its shape
};

}  // namespace eigentrail
