#include "continuation/step/step_judgement.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/step/step_certificate.hpp"
#include "continuation/step/step_error.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// Newton's method may arrive on another path. Between two points of one path the terms of the interpolant of
/// x fall; over a jump to another one they stay about as large as the jump. An estimated error of this share
/// of the way between the points tells a jump.
constexpr double jump_share = 0.1;
/// Share of the largest position below which x does not move.
constexpr double no_motion = 1e-6;

Verdict check_path(const PathProblem& problem, const PathFrame& frame, const Step& step) {
  if (problem.structure.fixed_equilibrium || problem.structure.known_equilibrium) return {};
  const VectorSeries& from = step.left->path.x;
  const VectorSeries& to = step.right.path.x;
  if (from.cols() < 3 || to.cols() != from.cols()) return {};
  const HermiteInterpolant x(step.h, from.cast<Complex>(), to.cast<Complex>());
  const double error = x.error_without_last().norm();
  const double way = (to.col(0) - from.col(0)).norm();
  const double largest = std::max(frame.largest_position, from.col(0).norm());
  if (error <= jump_share * way + no_motion * largest) return {};
  return {Verdict::Kind::no_equilibrium, -1, INFINITY, "the equilibrium found lies on another path"};
}

/// Whether a single mode has arrived at an eigenpair of another track.
bool have_merged(const PathProblem& problem, const Track& a, const Track& b, const SystemMatrix& mass) {
  const IdentityThresholds& thresholds = problem.thresholds.identity;
  if (b.pair.chart != a.pair.chart) return false;
  for (const Complex root : b.roots) {
    const double scale = std::max(std::abs(a.roots[0]), problem.reference(a.pair.chart));
    if (std::abs(a.roots[0] - root) > thresholds.merged_distance * scale) continue;
    if (b.size() > 1 ||
        modal_assurance(a.series.Z[0], b.series.Z[0], mass)(0, 0) > thresholds.merged_assurance)
      return true;
  }
  return false;
}

/// Modes may not arrive at the same eigenpair, and without a certificate their shapes must resemble those at
/// the beginning of the step.
Verdict check_identity(const PathProblem& problem, bool certify, const Step& step) {
  const SystemMatrix& mass = step.right.linearization.M[0];
  for (std::size_t i = 0; i < step.right.tracks.size(); ++i) {
    const Track& a = step.right.tracks[i];
    const auto verdict = [i](Verdict::Kind kind, const char* reason) {
      return Verdict{kind, static_cast<int>(i), INFINITY, reason};
    };
    if (a.size() > 1) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (have_merged(problem, a, step.right.tracks[j], mass))
        return verdict(Verdict::Kind::merged, "two modes arrived at the same eigenpair");
    }
    if (certify) continue;
    const double assurance = modal_assurance(a.series.Z[0], step.left->tracks[i].series.Z[0], mass)(0, 0);
    if (assurance < problem.thresholds.identity.least_assurance)
      return verdict(Verdict::Kind::mismatch, "a mode is not recognized by its shape");
  }
  return {};
}

}  // namespace

bool may_stay_uncertified(const PathFrame& frame, double h) {
  return std::abs(h) <= uncertified_share * frame.coordinate_range();
}

Verdict judge(const PathProblem& problem, const PathFrame& frame, const TraceOptions& options,
              const Step& step, RunCounts& counts) {
  if (Verdict verdict = check_path(problem, frame, step); !verdict.accepted()) return verdict;
  Verdict verdict = judge_error(problem, frame, options.tolerance, step);
  if (!verdict.accepted()) return verdict;
  const double error = verdict.error;
  {
    const StageTimer timer(counts.matching_seconds);
    verdict = check_identity(problem, options.certify, step);
  }
  if (verdict.accepted() && options.certify) {
    verdict.certified = certify(problem, step, may_stay_uncertified(frame, step.h), counts);
    const auto open = std::find(verdict.certified.begin(), verdict.certified.end(), false);
    if (open != verdict.certified.end()) {
      verdict.kind = Verdict::Kind::uncertified;
      verdict.track = static_cast<int>(open - verdict.certified.begin());
      verdict.reason = "the certificate does not close";
    }
  }
  // Why a step is refused for other reasons says nothing about its length.
  const bool is_known = verdict.accepted() || verdict.kind == Verdict::Kind::uncertified;
  verdict.error = is_known ? error : INFINITY;
  return verdict;
}

}  // namespace eigentrail
