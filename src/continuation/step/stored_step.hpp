// A step as it is stored: series of its blocks at both ends, of the order of the dense output.
#pragma once

#include "continuation/step/step.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// `certified`, per track, is what the judgement found. A block counts as certified when its modes can also
/// be told apart on the dense output, in both directions.
PathStep stored_step(const PathProblem& problem, const Step& step, const std::vector<bool>& certified);

}  // namespace eigentrail
