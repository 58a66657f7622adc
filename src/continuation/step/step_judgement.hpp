// Judgement whether a step is accepted: its equilibrium lies on the path, its dense output is accurate, and
// its modes are the same at both ends.
#pragma once

#include "continuation/path/path_frame.hpp"
#include "continuation/step/step.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Steps up to this share of the range are accepted even if the certificate of a track fails, and the track
/// is marked as uncertified there. If it fails on so short a step, it would fail on any, as where two modes
/// coincide. With a larger value more steps stay uncertified, with a smaller one more attempts are needed
/// before such a place is passed.
constexpr double uncertified_share = 1e-6;

/// Whether a step of length h is so short that it is accepted although a certificate fails.
bool may_stay_uncertified(const PathFrame& frame, double h);

/// What becomes of a step whose certificate fails.
enum class Uncertified {
  is_rejected,
  passes,          ///< because a shorter step would fail as well
  passes_by_shape  ///< if the shapes of the modes at both ends resemble each other
};

/// Evidence that no modes were exchanged on a step (certificate.hpp): per track, whether it is certified.
/// Without `all_count`, the tracks behind the first one that fails a strict test are not tested, because the
/// step is rejected then. A strict test that would take too much work becomes a lenient one. Several threads
/// share the tracks. Work is added to `counts`.
std::vector<bool> certify(const PathProblem& problem, const Step& step, bool all_count,
                          std::vector<TrackTest>& tests, RunCounts& counts);

/// Judges a step whose points have been computed. A verdict that is accepted or `uncertified` has the error
/// and the certified tracks; those behind the first that failed are tested only if the step may pass. `tests`
/// of tracks that would take too much work become lenient.
Verdict judge(const PathProblem& problem, const PathFrame& frame, const TraceOptions& options,
              const Step& step, Uncertified uncertified, std::vector<TrackTest>& tests, RunCounts& counts);

}  // namespace eigentrail
