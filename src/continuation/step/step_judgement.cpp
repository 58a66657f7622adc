#include "continuation/step/step_judgement.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "continuation/step/modal_certificate.hpp"
#include "continuation/step/shared_basis.hpp"
#include "continuation/step/step_error.hpp"
#include "continuation/tracks/members.hpp"
#include "core/parallel.hpp"
#include "eigentrail/continuation/certificate.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// Newton's method for the equilibrium may converge to a point of another path. Between two points of one
/// path the terms of the interpolant of x decrease; between points of different paths they stay about as
/// large as the distance. If the estimated error of x exceeds this share of the distance between the points,
/// the step is rejected. A larger value may miss a change of the path, a smaller one rejects steps on
/// strongly curved paths.
constexpr double jump_share = 0.1;
/// Added to the accepted error of x, as a share of the largest position so far, so that rounding of an x that
/// hardly moves is not taken for a jump.
constexpr double no_motion = 1e-6;

/// The same for the trimmed parameters, each in units of its scale: they alone tell two paths apart where x
/// hardly moves.
bool unknowns_stay(const PathFrame& frame, const Step& step) {
  const Vector& sizes = frame.largest_unknowns;
  if (sizes.size() == 0) return true;
  const Matrix from = step.left->path.lambda.bottomRows(sizes.size());
  const Matrix to = step.right.path.lambda.bottomRows(sizes.size());
  const HermiteInterpolant u(step.h, from.cast<Complex>(), to.cast<Complex>());
  const double way = Vector(to.col(0) - from.col(0)).cwiseQuotient(sizes).norm();
  return u.error_without_last().cwiseQuotient(sizes).norm() <= jump_share * way + no_motion;
}

/// Whether the right point lies on the same path as the left one.
Verdict check_path(const PathProblem& problem, const PathFrame& frame, const Step& step) {
  if (problem.structure.fixed_equilibrium || problem.structure.known_equilibrium) return {};
  const VectorSeries& from = step.left->path.x;
  const VectorSeries& to = step.right.path.x;
  if (from.cols() < 3 || to.cols() != from.cols()) return {};
  const HermiteInterpolant x(step.h, from.cast<Complex>(), to.cast<Complex>());
  const double error = x.error_without_last().norm();
  const double way = (to.col(0) - from.col(0)).norm();
  const double largest = std::max(frame.largest_position, from.col(0).norm());
  const bool moves = way > no_motion * largest;
  if (error <= jump_share * way + no_motion * largest && (moves || unknowns_stay(frame, step))) return {};
  return {Verdict::Kind::no_equilibrium, -1, INFINITY, "the equilibrium found lies on another path"};
}

/// Whether the single mode `a` has converged to an eigenpair of the track `b`.
bool have_merged(const PathProblem& problem, const Track& a, const Track& b, const SystemMatrix& mass) {
  const IdentityThresholds& thresholds = problem.thresholds.identity;
  if (b.pair.part != a.pair.part) return false;
  for (const Complex root : roots_in_chart(b, a.pair.chart)) {
    const double scale = std::max(std::abs(a.roots[0]), problem.reference(a.pair.chart));
    if (std::abs(a.roots[0] - root) > thresholds.merged_distance * scale) continue;
    if (b.size() > 1 ||
        modal_assurance(a.series.Z[0], b.series.Z[0], mass)(0, 0) > thresholds.merged_assurance)
      return true;
  }
  return false;
}

Verdict rejection(Verdict::Kind kind, std::size_t track, const char* reason) {
  return {kind, static_cast<int>(track), INFINITY, reason};
}

/// Whether all tracks are at different eigenpairs.
Verdict check_distinct(const PathProblem& problem, const Step& step) {
  const SystemMatrix& mass = step.right.linearization.M[0];
  const std::vector<Track>& tracks = step.right.tracks;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].size() > 1) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (have_merged(problem, tracks[i], tracks[j], mass))
        return rejection(Verdict::Kind::merged, i, "two modes arrived at the same eigenpair");
    }
  }
  return {};
}

/// Whether the shapes of single modes that are not certified resemble those at the begin of the step.
Verdict check_shapes(const PathProblem& problem, const Step& step, const std::vector<bool>& certified) {
  const SystemMatrix& mass = step.right.linearization.M[0];
  for (std::size_t i = 0; i < certified.size(); ++i) {
    const Track& track = step.right.tracks[i];
    if (track.size() > 1 || certified[i]) continue;
    const ComplexMatrix& before = step.left->tracks[i].series.Z[0];
    if (modal_assurance(track.series.Z[0], before, mass)(0, 0) < problem.thresholds.identity.least_assurance)
      return rejection(Verdict::Kind::mismatch, i, "a mode is not recognized by its shape");
  }
  return {};
}

/// Distance of the eigenvalues of a track from the nearest other known eigenvalue in its chart, the
/// conjugates of the track included.
double gap_of(const PathNode& node, std::size_t index) {
  const Track& track = node.tracks[index];
  double gap = INFINITY;
  for (const Complex root : track.roots) {
    if (!track.pair.is_real) gap = std::min(gap, 2.0 * std::abs(root.imag()));
    for (std::size_t j = 0; j < node.tracks.size(); ++j) {
      const Track& other = node.tracks[j];
      if (j == index || other.pair.part != track.pair.part) continue;
      for (const Complex here : roots_in_chart(other, track.pair.chart)) {
        if (std::isfinite(here.real())) gap = std::min(gap, std::abs(here - root));
      }
    }
  }
  return gap;
}

/// Whether the two eigenvalues of a block come so close on a step, and do not meet there, that rounding
/// decides which is which behind it.
bool are_exchanged_by_rounding(const PathProblem& problem, const Step& step, std::size_t i) {
  const Track& track = step.left->tracks[i];
  if (track.size() != 2 || step.meets(i) || track.departure) return false;
  const HermiteInterpolant dense = functions_on_step(*step.left, step.right, i, step.h);
  const auto are_one = [&](double t) {
    const ComplexVector functions = dense(t), roots = block_roots(functions);
    const double errors = rounding_of_roots(track, functions, roots, problem.thresholds.rounding).sum();
    return std::abs(roots[0] - roots[1]) <= errors;
  };
  ComplexMatrix halves = dense.series(0.0, dense.degree());  // of the distance, with both signs
  halves.row(0).setZero();
  return are_one(place_of_least_magnitude(halves)) && !(are_one(0.0) && are_one(1.0));
}

}  // namespace

std::vector<bool> certify(const PathProblem& problem, const Step& step, bool all_count,
                          std::vector<TrackTest>& tests, RunCounts& counts) {
  const StageTimer timer(counts.certificate_seconds);
  const PathNode& left = *step.left;
  const std::size_t count = left.tracks.size();
  if (std::all_of(tests.begin(), tests.end(), [](TrackTest test) { return test == TrackTest::none; }))
    return std::vector<bool>(count, false);
  std::vector<std::unique_ptr<const StepPencil>> pencils;
  const std::size_t parts = std::max<std::size_t>(left.pencil.parts.size(), 1);
  std::vector<bool> certified(count, false);
  const double work_before = counts.certificate_work;
  for (std::size_t i = 0; i < parts; ++i) {
    const int part = static_cast<int>(i);
    pencils.push_back(std::make_unique<const StepPencil>(left, step.right, step.h, part));
    const std::vector<bool> of_part = certify_all(*pencils.back(), step.right, part, counts);
    for (std::size_t j = 0; j < count; ++j) certified[j] = certified[j] || of_part[j];
  }
  // With several threads, tracks behind the first one that fails may have been tested already. Their results
  // and their work are dropped, so that nothing depends on the number of threads.
  std::vector<RunCounts> own(count);
  std::vector<char> closed(certified.begin(), certified.end());
  std::atomic<std::size_t> first_open{count};
  const auto look = [&](std::size_t i) {
    if (closed[i] != 0 || tests[i] == TrackTest::none || (!all_count && i > first_open)) return;
    const StepPencil& pencil = *pencils[static_cast<std::size_t>(left.tracks[i].pair.part)];
    bool gave_up = false;
    closed[i] =
        certify_step(pencil, left.tracks[i], step.right.tracks[i], gap_of(left, i), own[i], &gave_up) ? 1 : 0;
    if (gave_up) tests[i] = TrackTest::lenient;
    if (closed[i] != 0 || tests[i] != TrackTest::strict) return;
    for (std::size_t known = first_open; i < known && !first_open.compare_exchange_weak(known, i);) {
    }
  };
  // Blocks are behind single modes and take longer. With several threads they are tested first.
  const int threads = is_worth_sharing(count, left.pencil.size()) ? problem.threads : 1;
  in_parallel(count, threads, [&](std::size_t i) { look(threads > 1 ? count - 1 - i : i); });
  const double work_for_all = counts.certificate_work - work_before;
  for (std::size_t i = 0; i < count; ++i) {
    const bool counts_here = all_count || i <= first_open;
    if (closed[i] == 0) counts.certificate_in_vain += work_for_all / static_cast<double>(count);
    certified[i] = closed[i] != 0 && counts_here;
    if (!counts_here) continue;
    counts.certificate_factorizations += own[i].certificate_factorizations;
    counts.certificate_work += own[i].certificate_work;
    if (closed[i] == 0) counts.certificate_in_vain += own[i].certificate_work;
  }
  return certified;
}

bool may_stay_uncertified(const PathFrame& frame, double h) {
  return std::abs(h) <= uncertified_share * frame.coordinate_range();
}

Verdict judge(const PathProblem& problem, const PathFrame& frame, const TraceOptions& options,
              const Step& step, Uncertified uncertified, std::vector<TrackTest>& tests, RunCounts& counts) {
  if (Verdict verdict = check_path(problem, frame, step); !verdict.accepted()) return verdict;
  Verdict verdict = judge_error(problem, frame, options.tolerance, step);
  if (!verdict.accepted()) return verdict;
  {
    const StageTimer timer(counts.matching_seconds);
    if (Verdict distinct = check_distinct(problem, step); !distinct.accepted()) return distinct;
  }
  std::vector<bool> certified(step.right.tracks.size(), false);
  bool by_shape = !options.certify || uncertified == Uncertified::passes_by_shape;
  if (options.certify) {
    certified = certify(problem, step, uncertified != Uncertified::is_rejected, tests, counts);
    for (std::size_t i = 0; i < certified.size(); ++i) {
      if (certified[i] || verdict.kind == Verdict::Kind::uncertified) continue;
      if (tests[i] != TrackTest::strict) {
        by_shape = true;
        continue;
      }
      verdict.kind = Verdict::Kind::uncertified;
      verdict.track = static_cast<int>(i);
      verdict.reason = "the certificate does not close";
    }
  }
  const bool is_rejected =
      verdict.kind == Verdict::Kind::uncertified && uncertified == Uncertified::is_rejected;
  if (by_shape && !is_rejected) {
    const StageTimer timer(counts.matching_seconds);
    if (Verdict shapes = check_shapes(problem, step, certified); !shapes.accepted()) return shapes;
  }
  if (options.certify) {
    for (std::size_t i = 0; i < certified.size(); ++i)
      certified[i] = certified[i] && !are_exchanged_by_rounding(problem, step, i);
    verdict.certified = std::move(certified);
  }
  return verdict;
}

}  // namespace eigentrail
