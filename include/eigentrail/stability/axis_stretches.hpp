// Splits the path at the places where eigenvalues meet the imaginary axis ("cuts"). Between two cuts lies a
// stretch. On a stretch the stability is constant. The number of growing modes changes there only if a
// growing complex pair becomes two growing real modes, or the reverse.
//
// The cuts are the located events. The stability of a stretch follows from samples: the stored points, which
// are accurate to rounding, and the dense output at several places of every step and at the extrema of the
// margin between them. A sample of the dense output counts only if the real parts exceed its error. Where
// samples show a sign change without an event (for example an eigenvalue that passes through infinity), a cut
// is added.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/recorded_path.hpp"

namespace eigentrail {

enum class Stability {
  stable,    ///< every mode decays
  marginal,  ///< no mode grows; some are on the imaginary axis within rounding, as without damping
  unstable,  ///< some mode grows
  undecided  ///< errors of the model's data leave it open (undecided_ranges.hpp)
};

std::string stability_name(Stability stability);

/// A place where stability may change: an event, an end of the trace, or a sign change in the dense output.
struct AxisCut {
  PathPosition at;
  double p = 0.0;
  Complex s = {};          ///< the eigenvalue there, 1/s; not used for an end of the trace
  std::vector<int> modes;  ///< modes that meet the axis, numbered from 0, ascending
  std::string cause;       ///< name of the event; "start", "end", "infinity" or "sign change"
  bool on_axis = true;     ///< false for an end of the trace without an event
  bool passes = false;     ///< the modes pass from one side of the axis to the other: flutter, divergence
  bool turns = false;      ///< the path may turn back here: fold or branch point
};

/// All modes at one place.
struct AxisSample {
  PathPosition at;
  double margin = 0.0;        ///< -max Re s, 1/s
  int critical = -1;          ///< the mode with the largest Re s; -1: no mode exists that moves
  double doubt = 0.0;         ///< error bound of its Re s, 1/s
  std::vector<int> unstable;  ///< modes with Re s above its error bound
  std::vector<int> decaying;  ///< modes with Re s below minus its error bound
  std::vector<int> open;      ///< all others that exist and move
  bool exact = false;         ///< a stored point, not a place on the dense output

  bool all_decay() const { return unstable.empty() && open.empty(); }
};

struct AxisStretch {
  AxisCut from, to;
  Stability stability = Stability::marginal;
  /// Modes (numbered from 0, ascending) that grow: by a sample or, where the error of the dense output hides
  /// that at all of them, by a neighbouring stretch and what passes the axis between them.
  std::vector<int> growing = {};
  /// Whether no mode grows that is not followed, by the stored points inside and next to it. Where some grow
  /// the stretch is unstable.
  bool whole = false;
  /// Samples inside, in the order of the trace, and at those ends that are not on the axis; at least one.
  std::vector<AxisSample> samples = {};
};

/// Accuracy of the dense output: the error of s is at most tolerance * max(|s|, reference).
struct EigenvalueAccuracy {
  double tolerance = 1e-6;
  double reference = 0.0;  ///< 1/s
};

/// The stretches from the first point of `path` to the last, in the order of the trace; none if there are
/// fewer than two points. Modes that are zero throughout (permanent_modes.hpp) are left out. `events`: all
/// events of the trace, in any order.
std::vector<AxisStretch> axis_stretches(const RecordedPath& path, const std::vector<Event>& events,
                                        const EigenvalueAccuracy& accuracy);

/// Number of growing modes at a place of the stretch, of which a sample was taken. A mode whose Re s is
/// within its error bound counts as growing if it grows on the stretch. The result is 0 if the stretch is not
/// unstable, and at least 1 if it is.
int count_growing(const AxisStretch& stretch, const AxisSample& sample);

}  // namespace eigentrail
