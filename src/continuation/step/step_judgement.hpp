// Whether a step is taken: its equilibrium lies on the path, its dense output is accurate, and its modes are
// those that it began with.
#pragma once

#include "continuation/path/path_frame.hpp"
#include "continuation/step/step.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Steps shorter than this share of the range are taken without a certificate, and marked so: a certificate
/// that does not close on so short a step will not close on any, as where two modes coincide.
constexpr double uncertified_share = 1e-6;

/// Whether a step is so short that it is taken although its certificate does not close.
bool may_stay_uncertified(const PathFrame& frame, double h);

/// Judges a step whose points are solved. An accepted verdict carries its error and the certified tracks.
Verdict judge(const PathProblem& problem, const PathFrame& frame, const TraceOptions& options,
              const Step& step, RunCounts& counts);

}  // namespace eigentrail
