#include "continuation/step/step_certificate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "continuation/step/modal_certificate.hpp"
#include "core/parallel.hpp"
#include "eigentrail/continuation/certificate.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/point_modes.hpp"

namespace eigentrail {
namespace {

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
      for (const Complex s : other.roots) {
        // Into either chart from the other one it is the reciprocal.
        const Complex here = other.pair.chart == track.pair.chart ? s : chart_value(s, Chart::reciprocal);
        if (std::isfinite(here.real())) gap = std::min(gap, std::abs(here - root));
      }
    }
  }
  return gap;
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

}  // namespace eigentrail
