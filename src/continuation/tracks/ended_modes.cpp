#include "continuation/tracks/ended_modes.hpp"

#include <sstream>

#include "continuation/tracks/completeness.hpp"
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

}  // namespace eigentrail
