// Multibody scenes on the range of a trace: whether they rest, and their independent parts: those of a family
// of matrices follow from its coefficients, a scene has none.
//
// A complex part has eigenvalues on both sides of the real axis. Those below are the conjugates of modes of
// its conjugate part. While none of them is near the axis, the modes with Im s >= 0 of both are all modes of
// the pair. A mode that passes through the axis would go over to the conjugate part. Such a pair is followed
// as one real part.
#pragma once

#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// What holds for the equilibrium of a scene on the range of a trace.
struct SceneOnRange {
  bool rests = false;  ///< its positions and the constraints do not change; the multipliers may
  std::shared_ptr<const IndependentParts> parts;  ///< null where the equations do not fall apart
};

/// Looks at a scene with the equilibrium (x, lambda) at the start, at a few places of the range, and at those
/// where an expression has a narrow bump or a kink. It counts as
/// resting if x is an equilibrium at all of them: positions are analytic functions of the parameter. Scenes
/// whose positions move have parts where their constraints do not change. Models that give their coefficients
/// are not looked at, nor are traces that leave their path at a branch point. Costs a dozen linearizations;
/// where positions move, equilibria: two, or a dozen where the equations at these two fall apart.
SceneOnRange scene_on_range(const PathProblem& problem, const TraceOptions& options, const Vector& x,
                            const Vector& lambda);

/// The same with the equilibrium that a trace begins with, for one that is resumed.
SceneOnRange scene_at_start(const PathProblem& problem, const TraceOptions& options);

/// The parts of a family. A conjugate pair is two complex parts if none of its eigenvalues is near the real
/// axis, or passes through it or through infinity, at some places of the range; else one real part. Null
/// where the equations neither fall apart nor need balancing. Cost: that of find_independent_parts, and for
/// complex parts a few spectra without vectors.
std::shared_ptr<const IndependentParts> parts_of_family(const PathProblem& problem,
                                                        const TraceOptions& options);

/// Whether an eigenvalue is near the real axis: |Im s| is below a small share of |s|, or not above
/// `smallest`, the magnitude that counts as zero. Both in 1/s.
bool is_near_real_axis(Complex s, double smallest);

/// Values of the traced parameter at which an expression of the model has a narrow bump or a steep
/// transition, and those beside its kinks, on both sides; ascending. Cost: that of narrow_places.
std::vector<double> narrow_landings(const PathProblem& problem, const TraceOptions& options);

}  // namespace eigentrail
