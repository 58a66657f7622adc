#include "continuation/tracks/towards_infinity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "continuation/tracks/ended_modes.hpp"
#include "continuation/tracks/members.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "core/reciprocal_condition.hpp"

namespace eigentrail {
namespace {

/// The step that ends where an eigenvalue has come back is longer by this factor: its place of infinity is
/// known from two terms of a series.
constexpr double well_behind = 1.2;
/// Reciprocal condition of M up to which an eigenvalue may be infinite: its |1/s| is about this share of that
/// of a typical one, squared.
constexpr double singular_mass = 1e-9;

/// Signed distance of the place where mu vanishes like a root; empty if it does not.
std::optional<double> distance_of_infinity(const ComplexVector& mu, const InfinityThresholds& thresholds) {
  if (mu.size() < 3 || mu[1] == 0.0) return std::nullopt;
  const Complex bends = 2.0 * mu[0] * mu[2] / (mu[1] * mu[1]);  // mu mu'' / mu'^2
  if (!(std::abs(bends + 1.0) <= thresholds.like_a_root)) return std::nullopt;
  const Complex distance = -0.5 * mu[0] / mu[1];
  if (!(std::abs(distance.imag()) <= thresholds.like_a_root * std::abs(distance.real()))) return std::nullopt;
  return distance.real();
}

}  // namespace

bool has_arrived(const PathProblem& problem, const PathNode& node, Complex s,
                 const InfinityThresholds& thresholds) {
  if (std::abs(s) <= thresholds.arrived * problem.s_max) return true;
  return reciprocal_condition(Eigen::PartialPivLU<Matrix>(node.pencil.M[0])) > singular_mass;
}

std::vector<RunToInfinity> runs_to_infinity(const PathNode& node, double direction,
                                            const InfinityThresholds& thresholds) {
  std::vector<RunToInfinity> runs;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    const Track& track = node.tracks[i];
    for (int j = 0; j < static_cast<int>(track.size()); ++j) {
      const ComplexVector mu = root_series(track, track.roots[j], Chart::reciprocal);
      const auto distance = distance_of_infinity(mu, thresholds);
      if (distance && *distance * direction > 0.0)
        runs.push_back({i, j, std::abs(*distance), 1.0 / std::abs(mu[0])});
    }
  }
  return runs;
}

EndedAtInfinity end_at_infinity(const PathProblem& problem, const std::vector<RunToInfinity>& runs,
                                PathNode& node, RunCounts& counts, const InfinityThresholds& thresholds) {
  EndedAtInfinity ended;
  for (std::size_t track = node.tracks.size();
       track-- > 0;) {  // from the last on: those in front keep their places
    std::vector<int> members;
    double behind = 0.0;
    for (const RunToInfinity& run : runs) {
      if (run.track != track || !(run.magnitude >= thresholds.leaves * problem.s_max)) continue;
      members.push_back(run.member);
      // |s| falls like 1 / sqrt(distance) on the other side, too.
      const double share = run.magnitude / (thresholds.arrived * problem.s_max);
      behind = std::max(behind, run.distance * (1.0 + well_behind * share * share));
    }
    if (members.empty()) continue;
    std::vector<int>& modes = node.tracks[track].modes;
    const std::vector<int> beside = other_members(node.tracks[track].size(), members);
    // Conjugates and guard modes do not go on by themselves.
    const bool some_go_on = std::any_of(beside.begin(), beside.end(),
                                        [&](int j) { return modes[static_cast<std::size_t>(j)] >= 0; });
    std::optional<Track> others;
    if (some_go_on) {
      others = without(problem, node, node.tracks[track], members, counts);
      if (!others) continue;
    }
    for (const int j : beside) modes[static_cast<std::size_t>(j)] = Track::no_mode;
    std::copy_if(modes.begin(), modes.end(), std::back_inserter(ended.modes),
                 [](int mode) { return mode >= 0; });
    std::vector<EndedTrack> not_looked_for;
    const std::string who = end_track(problem, node, track, not_looked_for);
    if (!who.empty()) ended.who.push_back(who);
    if (others) node.tracks.push_back(std::move(*others));
    ended.behind = std::max(ended.behind, behind);
  }
  return ended;
}

}  // namespace eigentrail
