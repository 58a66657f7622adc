// Complex parts along a trace: where they may no longer be followed by themselves.
#pragma once

#include "continuation/trace/trace_state.hpp"

namespace eigentrail {

/// Whether an eigenvalue of a complex part is near the real axis at a point, or below it.
bool is_near_real_axis(const PathProblem& problem, const PathNode& node);

/// Makes all conjugate pairs of the parts real parts. Returns the new index of every part.
std::vector<int> join_pairs(PathProblem& problem);

/// Follows all conjugate pairs as real parts, from the last point on.
void join_conjugate_parts(PathProblem& problem, TraceState& state);

}  // namespace eigentrail
