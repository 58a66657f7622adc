#include "continuation/path/other_path.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Half the length of the first bridge on the other path, in the scaled coordinate. Shorter bridges follow,
/// by the factor `crossing_shrinking`, until one is accurate or the shortest length is reached.
constexpr double first_reach = 0.05;
constexpr double shortest_reach = 1e-4;
constexpr double crossing_shrinking = 0.6;
/// Relative to the scales of x and p: a path that passes the branch point at a larger distance is not the one
/// that crosses there.
constexpr double same_point = 1e-8;
/// The branch point is a pitchfork if the changes of p on both sides differ by at most this share of the sum
/// of their magnitudes. They are compared half way to the ends of the bridge, where the odd terms of p(sigma)
/// are still small against the even ones.
constexpr double alike = 1e-3;
/// As a share of half the length of the bridge, in scaled coordinates: if no coordinate changes by more, the
/// note does not mention any.
constexpr double no_motion = 1e-6;

/// A plane across the other path. Its normal is the longer of the two kernel directions after its component
/// along the trace's own path is removed, in scaled coordinates.
std::optional<PathPlane> plane_across(const PointSolver& solver, const PathNode& node) {
  const PathProblem& problem = solver.problem();
  const PathScales scales = solver.frame().scales();
  Matrix directions = directions_at_branch_point(problem.model, node.path, problem.traced, node.linearization,
                                                 node.basis.T[0], solver.counts().evaluations);
  if (directions.size() == 0 || !directions.allFinite()) return std::nullopt;
  const Eigen::Index n = node.path.x.rows();
  directions.topRows(n) /= scales.x;
  directions.row(n) /= scales.p;
  directions.colwise().normalize();
  Vector own(n + 1);
  const Vector dx = node.path.x.cols() > 1 ? Vector(node.path.x.col(1)) : Vector(Vector::Zero(n));
  own << dx / scales.x, solver.frame().speed(node) / scales.p;
  own.normalize();
  const Matrix others = directions - own * (own.transpose() * directions);
  const bool first = others.col(0).norm() >= others.col(1).norm();
  const Vector normal = others.col(first ? 0 : 1).normalized();
  return PathPlane{normal.head(n) / scales.x, normal[n] / scales.p};
}

/// A point of the other path on the plane at a distance from the branch point.
std::optional<SidePoint> side_point_on(const PointSolver& solver, const PathPlane& plane,
                                       const PathNode& node, double distance) {
  const PathScales scales = solver.frame().scales();
  const double squared = plane.x.squaredNorm() * std::pow(scales.x, 2) + std::pow(plane.p * scales.p, 2);
  const Vector x = node.path.x.col(0) + distance / squared * std::pow(scales.x, 2) * plane.x;
  const double p = node.p + distance / squared * scales.p * scales.p * plane.p;
  const PathPoint point =
      reduce_at(solver.problem(), p, {x, Vector(), true}, node.basis.T[0], solver.counts(), plane);
  return side_point(solver, point, node.pencil.size());
}

/// A bridge along the other path, over the branch point. Empty if none is accurate enough.
std::optional<Bridge> bridge_along(const PointSolver& solver, const PathPlane& plane, const PathNode& node) {
  const PathScales scales = solver.frame().scales();
  const int traced = solver.problem().traced;
  std::optional<Bridge> best;
  double least = fair_bridge;
  const double here = plane(node.path.x.col(0), node.path.lambda.col(0), node.p);
  for (double reach = first_reach; reach > shortest_reach && least > good_bridge;
       reach *= crossing_shrinking) {
    const std::optional<SidePoint> left = side_point_on(solver, plane, node, -reach);
    const std::optional<SidePoint> right = side_point_on(solver, plane, node, reach);
    if (!left || !right) continue;
    const Bridge bridge(left->coordinate, right->coordinate, left->path, right->path, traced, true);
    const Path middle = bridge.path(here, 1);
    const double miss = std::max((middle.x.col(0) - node.path.x.col(0)).norm() / scales.x,
                                 std::abs(middle.parameters(traced, 0) - node.p) / scales.p);
    const double error = bridge.error(bridge_sizes(solver.frame(), node));
    if (miss > same_point || error > least) continue;
    best = bridge;
    least = error;
  }
  return best;
}

/// Changes of p and x on the other path from the branch point to both sides.
struct Departures {
  double rise_ahead = 0.0, rise_back = 0.0;  ///< change of p in the two directions
  Vector move;                               ///< change of x ahead
  Eigen::Index most = 0;                     ///< index of the coordinate that changes most
  bool moves = false;                        ///< whether that one changes at all
  bool is_vertical = false;                  ///< p stays: a line of equilibria, as where a spring is lost

  bool is_pitchfork() const {
    return std::abs(rise_ahead - rise_back) <= alike * (std::abs(rise_ahead) + std::abs(rise_back));
  }
};

Departures departures_on(const PointSolver& solver, const PathPlane& plane, const Bridge& bridge,
                         const PathNode& node) {
  const int traced = solver.problem().traced;
  const double here = plane(node.path.x.col(0), node.path.lambda.col(0), node.p);
  const double reach = 0.5 * std::abs(bridge.end() - bridge.begin());
  const Path ahead = bridge.path(here + 0.5 * reach, 1);
  const Path back = bridge.path(here - 0.5 * reach, 1);
  Departures changes;
  changes.rise_ahead = ahead.parameters(traced, 0) - node.p;
  changes.rise_back = back.parameters(traced, 0) - node.p;
  changes.is_vertical = std::max(std::abs(changes.rise_ahead), std::abs(changes.rise_back)) <=
                        same_point * solver.frame().scales().p;
  changes.move = ahead.x.col(0) - node.path.x.col(0);
  changes.move.cwiseAbs().maxCoeff(&changes.most);
  changes.moves = std::abs(changes.move[changes.most]) > no_motion * reach * solver.frame().scales().x;
  return changes;
}

/// A direction in words, such as "omega rises, blade x falls".
std::string in_words(const PathProblem& problem, const Departures& changes, double direction) {
  const ModelDescription& description = problem.model.description();
  const bool ahead = direction > 0.0;
  const double rise = ahead ? changes.rise_ahead : changes.rise_back;
  std::string text = description.parameters.names()[static_cast<std::size_t>(problem.traced)];
  text += changes.is_vertical ? " stays" : rise > 0.0 ? " rises" : " falls";
  if (!changes.moves) return text;
  text += ", " + description.coordinate_names[static_cast<std::size_t>(changes.most)];
  return text + ((changes.move[changes.most] > 0.0) == ahead ? " rises" : " falls");
}

}  // namespace

int choice_at(const std::vector<int>& wanted, std::size_t branch_point) {
  if (wanted.size() == 1) return wanted.front();
  return branch_point < wanted.size() ? wanted[branch_point] : 1;
}

BranchSurvey survey_branch_point(const PointSolver& solver, const PathNode& node, int choice,
                                 const std::string& where) {
  const std::string note = "another equilibrium path crosses at " + where;
  const std::optional<PathPlane> plane = plane_across(solver, node);
  const std::optional<Bridge> bridge = plane ? bridge_along(solver, *plane, node) : std::nullopt;
  if (!bridge) return {{}, note + "; the trace stays on its own: the other was not found"};
  const Departures changes = departures_on(solver, *plane, *bridge, node);
  const PathRange& range = solver.frame().range;
  const double towards = (range.to - range.from) * (changes.rise_ahead - changes.rise_back);
  const bool symmetric = changes.is_vertical || changes.is_pitchfork();
  const bool turns = symmetric ? changes.move[changes.most] < 0.0 : towards < 0.0;
  const double direction = turns ? -1.0 : 1.0;
  const PathProblem& problem = solver.problem();
  return {PathPlane{direction * plane->x, direction * plane->p},
          note +
              (changes.is_vertical ? " (a line of equilibria)"
               : symmetric         ? " (a pitchfork)"
                                   : "") +
              "; branch 1 is straight on, branch 2 leaves it (" + in_words(problem, changes, direction) +
              "), branch 3 does so the other way (" + in_words(problem, changes, -direction) +
              "); the trace took " + std::to_string(choice)};
}

std::optional<OtherStart> start_on_other_path(const PointSolver& solver, const PathNode& node,
                                              const PathPlane& other, int choice) {
  const double direction = choice == 2 ? 1.0 : -1.0;
  const PathPlane plane{direction * other.x, direction * other.p};
  const std::optional<Bridge> bridge = bridge_along(solver, plane, node);
  if (!bridge) return std::nullopt;
  OtherStart start{solver.frame(), {}, 0.5 * std::abs(bridge->end() - bridge->begin())};
  start.frame.plane = plane;
  start.frame.direction = 1.0;
  start.frame.bridge = bridge;
  // On either path the point is known as well as that path tells; both differ by the rounding of the
  // stiffness.
  const double here = start.frame.coordinate(node);
  start.frame.branch_point = {here, bridge->path(here, 1).parameters(solver.problem().traced, 0)};
  std::optional<SolvedPoint> there =
      PointSolver(solver.problem(), start.frame, solver.counts()).follow(all_tracks(node), 0.0);
  if (!there) return std::nullopt;
  start.node = std::move(there->node);
  return start;
}

}  // namespace eigentrail
