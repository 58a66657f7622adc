// Evidence that no modes were exchanged on a step, track by track. certificate.hpp describes the test.
#pragma once

#include "continuation/step/step.hpp"

namespace eigentrail {

/// Per track, whether it is certified. Without `all_count`, the tracks behind the first one that fails are
/// not tested, because the step is rejected then. Several threads share the tracks. Work is added to
/// `counts`.
std::vector<bool> certify(const PathProblem& problem, const Step& step, bool all_count, RunCounts& counts);

}  // namespace eigentrail
