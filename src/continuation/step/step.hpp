// One step of the trace (two neighbouring points), and the judgement whether it is accepted.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// A step from `left` to `right`. Both points have the same tracks in the same order.
struct Step {
  const PathNode* left = nullptr;  ///< the last point of the trace; must outlive the step
  PathNode right;
  double h = 0.0;                         ///< signed length, in the coordinate along the path
  std::vector<std::size_t> meeting = {};  ///< tracks whose eigenvalues meet on the right end
  /// Length of the accurate step that was cut to this one; 0 where it is not part of one.
  double whole = 0.0;

  /// Whether eigenvalues of this track meet on the right end.
  bool meets(std::size_t track) const {
    return std::find(meeting.begin(), meeting.end(), track) != meeting.end();
  }
};

/// How the certificate of a track is tested on a step.
enum class TrackTest {
  strict,   ///< if it fails, the step is treated as `Uncertified` says
  lenient,  ///< if it fails, the track passes by its shape: it failed on the last step, too
  none      ///< the track passes by its shape
};

/// Whether a step is accepted, and if not, why.
struct Verdict {
  enum class Kind {
    accepted,
    no_equilibrium,  ///< none was found, or one on another path
    mode_lost,       ///< the corrector did not converge, or a series is not finite
    inaccurate,      ///< the error of the dense output is above the accepted one
    mismatch,        ///< the shape of a mode changed too much (only without certificate)
    merged,          ///< two tracks converged to the same eigenpair
    uncertified      ///< the certificate of a track failed
  };

  Kind kind = Kind::accepted;
  int track = -1;      ///< index of the track that is the reason; -1: none in particular
  double error = 0.0;  ///< estimated error / accepted error; infinite if not known
  std::string reason = {};
  std::vector<bool> certified = {};  ///< per track; empty: none

  bool accepted() const { return kind == Kind::accepted; }
};

}  // namespace eigentrail
