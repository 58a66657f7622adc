// Modes that limit each other's accuracy are followed as one block.
#pragma once

#include "continuation/step/step.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// What decides about joining, beside the step itself.
struct JoiningRules {
  double tolerance = 1e-6;
  double parting_reach = 3.0;  ///< steps, see regrouping.hpp
  double longest_step = 0.0;   ///< of late, in the coordinate along the path
};

/// The partners with which a track on the step, whose error is `error` (a fraction of what is accepted),
/// would be so much more accurate as a block that a block is worth its cost: the nearest of the candidates
/// alone, or with those after it. Empty when nobody helps.
std::vector<Partner> helpful_partners(const PathProblem& problem, const JoiningRules& rules, const Step& step,
                                      std::size_t track, double error,
                                      const std::vector<Partner>& candidates);

/// At the end of a step, joins single modes that limit each other's accuracy, or changes the chart of one
/// that would do better in the other. `next_step` is the signed length of the next step.
Regroupings regroup_limiting_modes(const PathProblem& problem, const JoiningRules& rules, Step& step,
                                   double next_step, RunCounts& counts);

}  // namespace eigentrail
