// Multibody scenes on the range of a trace: whether they rest, and their independent parts: those of a family
// of matrices follow from its coefficients, a scene has none.
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

}  // namespace eigentrail
