// One step of the trace, as a value: two points, and what is known of the way between them.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// A step from `left` to `right`, whose tracks are those of `left`, in the same order.
struct Step {
  const PathNode* left = nullptr;  ///< the last point of the trace, which outlives the step
  PathNode right;
  double h = 0.0;                         ///< signed length, in the coordinate along the path
  std::vector<std::size_t> meeting = {};  ///< tracks whose eigenvalues meet on the right end
  /// Length of the accurate step that was cut to this one; 0 where it is not part of one.
  double whole = 0.0;
};

/// Whether a step is taken, and if not, what stands against it.
struct Verdict {
  enum class Kind {
    accepted,
    no_equilibrium,  ///< none was found, or one on another path
    mode_lost,       ///< the corrector did not converge, or a series is not finite
    inaccurate,      ///< the error of the dense output is above the tolerance
    mismatch,        ///< a mode has changed its shape too much (without certificate)
    merged,          ///< two tracks arrived at one eigenpair
    uncertified      ///< the certificate of identity does not close
  };

  Kind kind = Kind::accepted;
  int track = -1;      ///< the one to blame; -1: none in particular
  double error = 0.0;  ///< estimated error / accepted error; infinite where it is not known
  std::string reason = {};
  std::vector<bool> certified = {};  ///< per track; empty: none is

  bool accepted() const { return kind == Kind::accepted; }
};

}  // namespace eigentrail
