// Evidence that no modes were exchanged on a step, track by track. certificate.hpp describes the test.
#pragma once

#include "continuation/step/step.hpp"
#include "continuation/step/track_test.hpp"

namespace eigentrail {

/// Per track, whether it is certified. Without `all_count`, the tracks behind the first one that fails a
/// strict test are not tested, because the step is rejected then. A strict test that would take too much work
/// becomes a lenient one. Several threads share the tracks. Work is added to `counts`.
std::vector<bool> certify(const PathProblem& problem, const Step& step, bool all_count,
                          std::vector<TrackTest>& tests, RunCounts& counts);

}  // namespace eigentrail
