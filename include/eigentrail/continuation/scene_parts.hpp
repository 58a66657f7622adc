// Independent parts of a multibody scene at rest: those of a family of matrices follow from its coefficients,
// a scene has none.
#pragma once

#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// The parts in which the equations of a model fall apart on the range of a trace, from its matrices at a few
/// places. x, lambda: the equilibrium. Null where they do not fall apart, where equilibrium or constraints
/// change along the path, and for models that give their coefficients. Costs a dozen linearizations.
std::shared_ptr<const IndependentParts> parts_on_range(const PathProblem& problem,
                                                       const TraceOptions& options, const Vector& x,
                                                       const Vector& lambda);

}  // namespace eigentrail
