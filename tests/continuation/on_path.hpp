// A point on the path of a scene, and what belongs to it in a trace.
#pragma once

#include <optional>

#include "continuation/events/event_search.hpp"
#include "continuation/path/path_frame.hpp"
#include "eigentrail/core/text.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

/// Keeps references to itself, and so is neither copied nor moved.
struct OnPath {
  enum class With { no_modes, modes };

  /// The point at p, from the scene's own guess.
  explicit OnPath(Setting given, double p, With with = With::no_modes)
      : setting(std::move(given)),
        problem(setting.problem()),
        frame{PathRange{problem.traced, setting.options.from, setting.options.to}},
        points(problem, frame, counts),
        reduced(with == With::modes
                    ? point_from_guess(problem, p, counts)
                    : reduce_at(problem, p,
                                {problem.model.initial_guess(parameters_at(problem, p)), Vector()}, Matrix(),
                                counts)),
        node(differentiate_point(problem, reduced, counts).value_or(PathNode{})),
        log{events, frame.range, problem.thresholds},
        search{points, setting.options, criteria, log, 4} {
    frame.direction = setting.options.to > setting.options.from ? 1.0 : -1.0;
    frame.largest_position = reduced.equilibrium.x.norm();
  }
  OnPath(const OnPath&) = delete;
  OnPath& operator=(const OnPath&) = delete;

  /// The plane across the path here becomes the coordinate.
  void take_plane() {
    frame.plane = plane_along(node.path, problem.traced, frame.scales(), frame.direction);
    reparametrize(node, *frame.plane, problem.traced);
  }

  /// The point on the fold nearby, by Newton's method on dp/dsigma.
  PathNode on_fold() {
    PathNode here = node;
    for (int i = 0; i < 12; ++i) here = points.follow({here, {}}, fold_distance(frame, here))->node;
    return here;
  }

  Setting setting;
  PathProblem problem;
  RunCounts counts;
  PathFrame frame;
  PointSolver points;
  PathPoint reduced;
  PathNode node;
  std::vector<Criterion> criteria = {};
  std::vector<Event> events = {};
  EventLog log;
  EventSearch search;
};

/// data/scenes/spring_pendulum.toml: hangs from a spring that stays vertical, straight for every stiffness k
/// and tilted for k > `critical_stiffness`. `position` of the bob in the guess.
constexpr double critical_stiffness = 2.0 * 9.81 / 1.5;
inline const std::string hanging_straight = "[0, 0, -1.5]";
inline const std::string hanging_tilted = "[1.2, 0, -0.9]";
inline Setting spring_pendulum(const std::string& position, double from, double to,
                               OptionTexts overrides = {}) {
  overrides.insert(overrides.end(), {{"from", exact_text(from)}, {"to", exact_text(to)}});
  return scene_setting("spring_pendulum", overrides,
                       {{"[\"0.8 * length\", 0, \"-0.6 * length\"]", position}});
}

}  // namespace eigentrail::test
