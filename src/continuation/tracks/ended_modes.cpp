#include "continuation/tracks/ended_modes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "continuation/tracks/members.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Points at which an ended track is looked for. The farther away, the less its last pair is a start for
/// Newton's method; each look costs some factorizations.
constexpr int most_looks = 10;

/// Name of the coordinate with the largest amplitude in a shape.
const std::string& largest_motion(const Model& model, const ComplexVector& shape) {
  Eigen::Index most = 0;
  shape.cwiseAbs().maxCoeff(&most);
  return model.description().coordinate_names[static_cast<std::size_t>(most)];
}

/// "mode 3 (s = -0.1 + 2j, along y 1)", for every mode of a track.
std::string text_of(const Model& model, const Track& track) {
  std::ostringstream text;
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    const int mode = track.modes[static_cast<std::size_t>(i)];
    if (mode < 0) continue;
    const Complex s = chart_value(track.roots[i], track.pair.chart);
    text << (text.tellp() > 0 ? ", " : "") << "mode " << mode + 1 << " (s = " << s.real()
         << (s.imag() < 0.0 ? " - " : " + ") << std::abs(s.imag()) << "j, "
         << largest_motion(model, track.series.Z[0].col(i)) << ")";
  }
  return text.str();
}

/// The ended track at this point; empty if it is not recognized there.
std::optional<Track> at_point(const PathProblem& problem, const PathNode& node, const Track& ended,
                              RunCounts& counts) {
  InvariantPair start = ended.pair;
  start.Z = ended.series.Z[0];
  auto found = recognize(problem, node, start, counts);
  if (!found) return std::nullopt;
  Track& track = *found;
  track.roots = in_order_of(ended.roots, track.roots);
  track.modes = track.arriving = ended.modes;
  return found;
}

}  // namespace

std::string end_track(const PathProblem& problem, PathNode& node, std::size_t track,
                      std::vector<EndedTrack>& ended) {
  const auto place = node.tracks.begin() + static_cast<std::ptrdiff_t>(track);
  std::string text = text_of(problem.model, *place);
  ended.push_back({std::move(*place), 0});
  ended.back().track.departure.reset();
  ended.back().track.pair.factors.reset();
  node.tracks.erase(place);
  return text;
}

std::vector<std::string> find_again(const PathProblem& problem, PathNode& node,
                                    std::vector<EndedTrack>& ended, RunCounts& counts) {
  std::vector<std::string> found;
  if (ended.empty()) return found;
  const StageTimer timer(counts.matching_seconds);
  std::erase_if(ended, [&](EndedTrack& one) {
    if (auto track = at_point(problem, node, one.track, counts)) {
      found.push_back(text_of(problem.model, *track));
      node.tracks.push_back(std::move(*track));
      return true;
    }
    return ++one.looks >= most_looks;
  });
  return found;
}

namespace {

/// The step that ends where an eigenvalue has come back is longer by this factor: its place of infinity is
/// known from two terms of a series.
constexpr double well_behind = 1.2;

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
