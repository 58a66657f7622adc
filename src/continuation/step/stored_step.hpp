// Conversion of a step to the form in which it is stored: series of its blocks at both ends, of the order of
// the dense output.
#pragma once

#include "continuation/step/step.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// The stored form of a step. `certified`, per track, is the result of the judgement. A block is marked
/// certified only if its modes can also be distinguished on the stored dense output, followed in both
/// directions.
PathStep stored_step(const PathProblem& problem, const Step& step, const std::vector<bool>& certified);

}  // namespace eigentrail
