// Whether a step is taken, and what else may help where it is not.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "continuation/grouping_errors.hpp"
#include "continuation/least_magnitude.hpp"
#include "continuation/modal_certificate.hpp"
#include "continuation/regrouping.hpp"
#include "continuation/shared_basis.hpp"
#include "continuation/tracer.hpp"
#include "core/parallel.hpp"
#include "eigentrail/continuation/certificate.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// Within a block the eigenvalues count as no closer than this, relatively: at a meeting an error bound for
/// each of them cannot hold, and the block's own functions are what is accurate.
constexpr double least_relative_gap = 0.1;
/// Near a fold eigenvalues vary like the root of the distance in p: p must be known so much better, in units
/// of tolerance times range.
constexpr double parameter_accuracy = 1e-5;
constexpr double join_reach = 1.0;  ///< steps: meetings nearer than this join modes into a block
/// Single modes whose error is this share of what is accepted limit the step.
constexpr double limiting_error = 0.1;
constexpr double better_chart = 0.3;  ///< the same for the other chart, which costs nothing more
/// A block must be more accurate than its members by this factor to be worth its while.
constexpr double worthwhile = 0.05;
constexpr int most_merges_at_node = 12;
/// A diagonal modal assurance below this makes a match suspicious.
constexpr double least_assurance = 0.8;
/// Two tracks closer than this, relatively, with parallel vectors have merged.
constexpr double merged_distance = 1e-8;
constexpr double merged_assurance = 0.999;

}  // namespace

Tracer::Trouble Tracer::judge(double h, const PathNode& next, double& error) {
  certified_.assign(node_.tracks.size(), false);
  if (Trouble trouble = check_path(h, next)) return trouble;
  Trouble inaccuracy = measure_error(h, next);
  error = inaccuracy.error;
  if (error > 1.0) return inaccuracy;
  if (Trouble trouble = check_identity(next)) return trouble;
  return options_.certify ? certify(h, next) : Trouble{};
}

double Tracer::track_error(double h, const PathNode& next, std::size_t i) const {
  const Track& track = node_.tracks[i];
  const HermiteInterpolant step = functions_on_step(node_, next, i, h);
  const Vector errors = (step.error_without_last() - function_rounding(track.pair.Lambda)).cwiseMax(0.0);
  const auto degree = static_cast<int>(2 * track.functions.cols() - 1);
  const double smallest = place_of_least_magnitude(step.series(0.0, degree));
  double worst = 0.0;
  for (const double t : {0.0, 0.5, 1.0, smallest}) {
    const ComplexVector functions = step(t);
    // The smallest member has its error relative to itself.
    const double size = block_roots(functions).cwiseAbs().minCoeff();
    const double scale = std::max(size, problem_.reference(track.pair.chart));
    const double error = root_error(functions, errors, least_relative_gap * scale) /
                         (accepted_share * options_.tolerance * scale);
    worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
  }
  return worst;
}

/// The worst estimated error of the dense output on the step, as a fraction of what is accepted.
Tracer::Trouble Tracer::measure_error(double h, const PathNode& next) const {
  Trouble worst{Trouble::Kind::inaccurate, -1, 0.0,
                "the error of the dense output stays above the tolerance"};
  for (std::size_t i = 0; i < node_.tracks.size(); ++i) {
    const double error = track_error(h, next, i);
    if (error <= worst.error) continue;
    worst.error = error;
    worst.track = static_cast<int>(i);
  }
  if (plane_) {
    const auto row = [&](const PathNode& node) {
      return ComplexMatrix(node.path.parameters.row(problem_.traced).cast<Complex>());
    };
    const double error = HermiteInterpolant(h, row(node_), row(next)).error_without_last()[0] /
                         (parameter_accuracy * options_.tolerance * range());
    if (error > worst.error)
      worst = {Trouble::Kind::inaccurate, -1, error, "the parameter along the path is inaccurate"};
  }
  return worst;
}

/// The partners with which a track on the step to `next`, whose error is `error`, would be so much more
/// accurate as a block that it is worth its while; empty when nobody helps. The nearest alone, or with those
/// after it.
std::vector<Partner> Tracer::helpful_partners(double h, const PathNode& next, std::size_t track, double error,
                                              std::vector<Partner> candidates) const {
  const Track& there = next.tracks[track];
  const double scale = std::max(there.roots.cwiseAbs().mean(), problem_.reference(there.pair.chart));
  const double accepted = accepted_share * options_.tolerance * scale;
  std::vector<Partner> chosen;
  // Larger blocks are told less well, and hold more that may happen at once: only where steps keep shrinking.
  const bool shrinking = std::abs(h) < 0.25 * longest_step_;
  for (const Partner& candidate : candidates) {
    Eigen::Index size = there.size();
    for (const Partner& partner : chosen) size += next.tracks[partner.track].size();
    if (size + (candidate.track < next.tracks.size() ? next.tracks[candidate.track].size() : 0) > 2 &&
        !shrinking)
      break;
    if (candidate.track >= next.tracks.size() || chosen.size() > 4) break;
    // Those that are met farther away hardly matter, and larger blocks cost digits.
    if (candidate.distance > 1.5 * candidates.front().distance) break;
    chosen.push_back(candidate);
    const double together = error_as_block(node_, next, track, chosen, h, least_relative_gap * scale);
    if (together <= worthwhile * error * accepted) return chosen;
  }
  return {};
}

void Tracer::join_limiting_modes(double h, PathNode& next, double next_step) {
  // All are chosen before any is joined: joining reorders the tracks.
  struct Choice {
    std::uint64_t strand;
    std::vector<Partner> partners;
    std::vector<std::uint64_t> strands;  ///< of the partners
  };
  std::vector<Choice> choices;
  for (std::size_t i = 0; i < next.tracks.size() && i < node_.tracks.size(); ++i) {
    if (next.tracks[i].size() > 1 || node_.tracks[i].size() > 1) continue;
    const double error = track_error(h, next, i);
    if (error < limiting_error) continue;
    const double in_other_chart = error_in_other_chart(problem_, node_, next, i, h);
    if (in_other_chart < better_chart * error * accepted_share * options_.tolerance) {
      if (change_chart(problem_, next, i, result_.counts)) ++result_.regroupings.charts;
      return;
    }
    Choice choice{next.tracks[i].strand, {}, {}};
    choice.partners =
        helpful_partners(h, next, i, error, find_partners(next, i, direction_ * next_step, part_reach_));
    for (const Partner& partner : choice.partners)
      choice.strands.push_back(next.tracks[partner.track].strand);
    if (!choice.partners.empty()) choices.push_back(std::move(choice));
  }
  const auto index_of = [&next](std::uint64_t strand) {
    const auto found = std::find_if(next.tracks.begin(), next.tracks.end(),
                                    [&](const Track& track) { return track.strand == strand; });
    return static_cast<std::size_t>(found - next.tracks.begin());
  };
  for (Choice& choice : choices) {
    const std::size_t track = index_of(choice.strand);
    bool all_there = choice.strand != 0 && track < next.tracks.size();
    for (std::size_t i = 0; i < choice.partners.size(); ++i) {
      choice.partners[i].track = index_of(choice.strands[i]);
      all_there = all_there && choice.partners[i].track < next.tracks.size();
    }
    if (all_there && join(problem_, next, track, choice.partners, result_.counts))
      ++result_.regroupings.joined;
  }
}

/// Modes may not arrive at the same eigenpair, and without a certificate their shapes must resemble those at
/// the beginning of the step.
Tracer::Trouble Tracer::check_identity(const PathNode& next) {
  const StageTimer timer(result_.counts.matching_seconds);
  const SystemMatrix& mass = next.linearization.M[0];
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& a = next.tracks[i];
    if (a.size() > 1) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const Track& b = next.tracks[j];
      if (b.pair.chart != a.pair.chart) continue;
      for (Eigen::Index k = 0; k < b.size(); ++k) {
        const double distance = std::abs(a.roots[0] - b.roots[k]);
        if (distance > merged_distance * std::max(std::abs(a.roots[0]), problem_.reference(a.pair.chart)))
          continue;
        const bool parallel =
            b.size() > 1 || modal_assurance(a.series.Z[0], b.series.Z[0], mass)(0, 0) > merged_assurance;
        if (parallel) {
          return {Trouble::Kind::merged, static_cast<int>(i), INFINITY,
                  "two modes arrived at the same eigenpair"};
        }
      }
    }
    if (options_.certify) continue;
    const double assurance = modal_assurance(a.series.Z[0], node_.tracks[i].series.Z[0], mass)(0, 0);
    if (assurance < least_assurance) {
      return {Trouble::Kind::mismatch, static_cast<int>(i), INFINITY,
              "a mode is not recognized by its shape"};
    }
  }
  return {};
}

Tracer::Trouble Tracer::certify(double h, const PathNode& next) {
  const StageTimer timer(result_.counts.certificate_seconds);
  const StepPencil pencil(node_, next, h);
  if (problem_.route != ModeRoute::one_by_one) certified_ = certify_all(pencil, next, result_.counts);
  // A step that is too long is given up at the first mode whose tube does not close; with several threads
  // those behind it may have been looked at in vain.
  const bool all_count = std::abs(h) <= uncertified_below_;
  std::vector<RunCounts> own(node_.tracks.size());
  std::vector<char> closed(certified_.begin(), certified_.end());
  std::atomic<std::size_t> first_open{node_.tracks.size()};
  const auto look = [&](std::size_t i) {
    if (closed[i] != 0 || (!all_count && i > first_open)) return;
    closed[i] = certify_step(pencil, node_.tracks[i], next.tracks[i], gap_of(i), own[i]) ? 1 : 0;
    if (closed[i] != 0) return;
    for (std::size_t known = first_open; i < known && !first_open.compare_exchange_weak(known, i);) {
    }
  };
  // Shared, the blocks come first, which stand behind single modes and take longer.
  const std::size_t count = own.size();
  const int threads = is_worth_sharing(count, node_.pencil.size()) ? problem_.threads : 1;
  in_parallel(count, threads, [&](std::size_t i) { look(threads > 1 ? count - 1 - i : i); });
  for (std::size_t i = 0; i < own.size(); ++i) {
    certified_[i] = closed[i] != 0 && (all_count || i <= first_open);
    if (all_count || i <= first_open)
      result_.counts.certificate_factorizations += own[i].certificate_factorizations;
  }
  if (first_open == node_.tracks.size()) return {};
  return {Trouble::Kind::uncertified, static_cast<int>(first_open), INFINITY,
          "the certificate does not close"};
}

/// Distance of a track from the nearest other known eigenvalue of its chart.
double Tracer::gap_of(std::size_t index) const {
  const Track& track = node_.tracks[index];
  double gap = INFINITY;
  for (const Complex root : track.roots) {
    if (!track.pair.is_real) gap = std::min(gap, 2.0 * std::abs(root.imag()));
    for (std::size_t j = 0; j < node_.tracks.size(); ++j) {
      const Track& other = node_.tracks[j];
      if (j == index || other.pair.chart != track.pair.chart) continue;
      for (const Complex s : other.roots) gap = std::min(gap, std::abs(s - root));
    }
  }
  return gap;
}

bool Tracer::remedy(const Trouble& trouble, double h, const std::optional<PathNode>& next) {
  Rejections& rejections = result_.rejections;
  switch (trouble.kind) {
    case Trouble::Kind::no_equilibrium:
      ++rejections.no_equilibrium;
      return turn_to_plane(h);
    case Trouble::Kind::mode_lost:
      ++rejections.mode_lost;
      break;
    case Trouble::Kind::inaccurate:
      ++rejections.inaccurate;
      break;
    case Trouble::Kind::mismatch:
      ++rejections.mismatch;
      break;
    case Trouble::Kind::merged:
      ++rejections.merged;
      break;
    case Trouble::Kind::uncertified:
      ++rejections.uncertified;
      break;
    case Trouble::Kind::none:
      return false;
  }
  if (turn_to_plane(h)) return true;
  if (trouble.track < 0) return false;
  const auto track = static_cast<std::size_t>(trouble.track);
  if (prefers_other_chart(node_.tracks[track], h) && change_chart(problem_, node_, track, result_.counts)) {
    ++result_.regroupings.charts;
    return true;
  }
  if (merges_at_node_ >= most_merges_at_node) return false;
  std::vector<Partner> partners = find_partners(node_, track, h, join_reach);
  if (trouble.kind == Trouble::Kind::inaccurate && next) {
    partners = helpful_partners(h, *next, track, trouble.error, find_partners(node_, track, h, part_reach_));
  } else if (partners.size() > 1) {
    partners.resize(1);
  }
  if (partners.empty()) return false;
  ++merges_at_node_;
  if (!join(problem_, node_, track, partners, result_.counts)) return false;
  ++result_.regroupings.joined;
  return true;
}

}  // namespace eigentrail
