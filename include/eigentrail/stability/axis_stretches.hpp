// The path cut where eigenvalues meet the imaginary axis: on each stretch between, the number of growing
// modes changes only where a growing pair comes apart into two real modes, or the reverse.
//
// The cuts are the located events. What lies between them is told by the stored points, which are accurate to
// rounding, and by the dense output at several places of every step wherever real parts exceed its tolerance.
// A sign that changes without an event (an eigenvalue that passes through infinity) makes a cut of its own.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/recorded_path.hpp"

namespace eigentrail {

enum class Stability {
  stable,    ///< every mode decays
  marginal,  ///< no mode grows; some stay on the imaginary axis but for rounding, as without damping
  unstable   ///< some mode grows
};

std::string stability_name(Stability stability);

/// A place where stability may change: an event, an end of the trace, or a change seen in the dense output.
struct AxisCut {
  PathPosition at;
  double p = 0.0;
  Complex s = {};          ///< the eigenvalue there; of an end of the trace: not used
  std::vector<int> modes;  ///< from 0, ascending: those that meet the axis
  std::string cause;       ///< name of the event; "start", "end", "infinity" or "sign change"
  bool on_axis = true;     ///< some eigenvalue is on the imaginary axis there
  bool passes = false;     ///< the modes pass the axis: flutter and divergence
  bool turns = false;      ///< the path may turn back here
};

/// All modes at one place.
struct AxisSample {
  PathPosition at;
  double margin = 0.0;        ///< -max Re s, 1/s
  int critical = -1;          ///< the mode that has it; -1: no mode exists
  std::vector<int> unstable;  ///< modes that grow beyond doubt, ascending
  bool all_decay = false;     ///< every mode decays beyond doubt
  bool exact = false;         ///< a stored point
};

struct AxisStretch {
  AxisCut from, to;
  Stability stability = Stability::marginal;
  /// false: so short that the error of the dense output hides its real parts; a neighbour told instead, if
  /// any
  bool seen = true;
  /// Inside, as the trace goes, and at those ends that are on no axis; at least one.
  std::vector<AxisSample> samples = {};

  /// Whether a mode grows somewhere on the stretch.
  bool grows(int mode) const;
};

/// How well eigenvalues are known: the error of the dense output is at most tolerance * max(|s|, reference).
struct EigenvalueAccuracy {
  double tolerance = 1e-6;
  double reference = 0.0;  ///< 1/s
};

/// The stretches from the first point of `path` to the last, in the order of the trace; none when there are
/// fewer than two points. `events` as the trace reports them, in any order.
std::vector<AxisStretch> axis_stretches(const RecordedPath& path, const std::vector<Event>& events,
                                        const EigenvalueAccuracy& accuracy);

/// Number of modes that grow at a place of a stretch, at t of the path's step `step`, with the eigenvalues
/// `s` there: those with a positive real part. Where it lies within the error of the dense output, the
/// stretch as a whole tells.
int count_growing(const AxisStretch& stretch, const PathStep& step, double t, const ComplexVector& s,
                  const EigenvalueAccuracy& accuracy);

}  // namespace eigentrail
