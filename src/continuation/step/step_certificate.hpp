// Evidence that no modes were exchanged on a step, track by track (certificate.hpp says what it rests on).
#pragma once

#include "continuation/step/step.hpp"

namespace eigentrail {

/// Which tracks are certified. Unless `all_count`, nothing is done for the tracks behind the first one whose
/// certificate does not close: the step will not be taken then. Several threads share the tracks.
std::vector<bool> certify(const PathProblem& problem, const Step& step, bool all_count, RunCounts& counts);

}  // namespace eigentrail
