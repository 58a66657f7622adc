// Which of the paths that cross at a branch point the trace goes on along.
//
// Choice 1 is straight on. The other path leaves the point in two directions, choices 2 and 3: first the one
// on which the parameter heads for the end of the range, or, where both do so alike, the one on which the
// coordinate that moves most rises. It is met on planes across the part of the kernel of [K f] that the
// trace's own path does not have, and gets a bridge of its own.
#include <array>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/shared_basis.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

constexpr double first_reach = 0.05;  ///< half the length of a bridge at first, in units of the path's scales
constexpr double shortest_reach = 1e-4;
constexpr double same_point = 1e-8;  ///< the other path passes the branch point up to this, relatively
constexpr double glimpse = 1e-3;     ///< of a bridge: how far beside the point its modes are told apart

}  // namespace

int Tracer::choice_at(std::size_t branch_point) const {
  const std::vector<int>& wanted = options_.branch;
  if (wanted.size() == 1) return wanted.front();
  return branch_point < wanted.size() ? wanted[branch_point] : 1;
}

bool Tracer::leaves_path_at(const PathNode& node) const {
  return on_branch_point(coordinate(node.path.x.col(0), node.p)) && choice_at(branch_points_) != 1;
}

/// A plane across the other path: its normal has no share in the direction of the trace's own.
std::optional<PathPlane> Tracer::plane_across_other_path(const PathNode& node) {
  const PathScales scales = path_scales();
  Matrix directions =
      directions_at_branch_point(problem_.model, node.path, problem_.traced, node.linearization,
                                 node.basis.T[0], result_.counts.evaluations);
  if (directions.size() == 0 || !directions.allFinite()) return std::nullopt;
  const Eigen::Index n = node.path.x.rows();
  directions.topRows(n) /= scales.x;
  directions.row(n) /= scales.p;
  directions.colwise().normalize();
  Vector own(n + 1);
  own << node.path.x.col(1) / scales.x, coefficient(node.path.parameters, problem_.traced, 1) / scales.p;
  own.normalize();
  const Matrix others = directions - own * (own.transpose() * directions);
  const bool first = others.col(0).norm() >= others.col(1).norm();
  const Vector normal = others.col(first ? 0 : 1).normalized();
  return PathPlane{normal.head(n) / scales.x, normal[n] / scales.p};
}

/// The other path at a distance from the branch point.
std::optional<Tracer::Anchor> Tracer::anchor_on(const PathPlane& plane, const PathNode& node,
                                                double distance) {
  const double squared =
      plane.x.squaredNorm() * std::pow(path_scales().x, 2) + std::pow(plane.p * range(), 2);
  const Vector x = node.path.x.col(0) + distance / squared * std::pow(path_scales().x, 2) * plane.x;
  const double p = node.p + distance / squared * range() * range() * plane.p;
  return anchor_at(reduce_at(problem_, p, {x, Vector(), true}, node.basis.T[0], result_.counts, plane));
}

/// A bridge along the other path that passes the branch point.
std::optional<Bridge> Tracer::bridge_other_path(const PathPlane& plane, const PathNode& node) {
  std::optional<Bridge> best;
  double least = fair_bridge;
  const double here = plane(node.path.x.col(0), node.p);
  for (double reach = first_reach; reach > shortest_reach && least > good_bridge; reach *= 0.6) {
    const std::optional<Anchor> left = anchor_on(plane, node, -reach);
    const std::optional<Anchor> right = anchor_on(plane, node, reach);
    if (!left || !right) continue;
    const Bridge bridge(left->coordinate, right->coordinate, left->path, right->path, problem_.traced, true);
    const Path middle = bridge.path(here, 1);
    const double miss = std::max((middle.x.col(0) - node.path.x.col(0)).norm() / path_scales().x,
                                 std::abs(middle.parameters(problem_.traced, 0) - node.p) / range());
    const double error = bridge.error(bridge_sizes());
    if (miss > same_point || error > least) continue;
    best = bridge;
    least = error;
  }
  return best;
}

/// Looks where the other path leads, and says what there is to choose from.
void Tracer::survey_branch_point(const PathNode& node) {
  crossing_.reset();
  const int choice = choice_at(branch_points_);
  std::string note = "another equilibrium path crosses at " + at_parameter(node.p) + "; ";
  const std::optional<PathPlane> plane = plane_across_other_path(node);
  const std::optional<Bridge> bridge = plane ? bridge_other_path(*plane, node) : std::nullopt;
  if (!bridge) {
    result_.notes.push_back(note + "the trace stays on its own: the other was not found");
    return;
  }
  crossing_ = Crossing{*plane, 1.0};
  const double here = (*plane)(node.path.x.col(0), node.p);
  const double reach = 0.5 * std::abs(bridge->end() - bridge->begin());
  const auto change = [&](double distance) {
    const Path there = bridge->path(here + distance, 1);
    return std::pair(there.parameters(problem_.traced, 0) - node.p,
                     Vector(there.x.col(0) - node.path.x.col(0)));
  };
  const auto ahead_of_point = change(0.5 * reach);
  const double rise_ahead = ahead_of_point.first;
  const Vector& move = ahead_of_point.second;
  const double rise_back = change(-0.5 * reach).first;
  Eigen::Index most = 0;
  move.cwiseAbs().maxCoeff(&most);
  const double towards = (options_.to - options_.from) * (rise_ahead - rise_back);
  const bool alike = std::abs(rise_ahead - rise_back) <= 1e-3 * (std::abs(rise_ahead) + std::abs(rise_back));
  if (alike ? move[most] < 0.0 : towards < 0.0) crossing_->direction = -1.0;
  const bool moves = std::abs(move[most]) > 1e-6 * reach * path_scales().x;
  const auto words = [&](double direction) {
    const bool ahead = direction > 0.0;
    std::string text = options_.parameter + ((ahead ? rise_ahead : rise_back) > 0.0 ? " rises" : " falls");
    if (!moves) return text;
    text += ", " + problem_.model.description().coordinate_names[static_cast<std::size_t>(most)];
    return text + ((move[most] > 0.0) == ahead ? " rises" : " falls");
  };
  result_.notes.push_back(note + "branch 1 is straight on, branch 2 leaves it (" +
                          words(crossing_->direction) + "), branch 3 does so the other way (" +
                          words(-crossing_->direction) + "); the trace took " + std::to_string(choice));
}

/// Continues from the branch point that was just reached on the path of the given choice.
bool Tracer::leave_path(int choice) {
  const auto fail = [this] {
    return stop(TraceStatus::no_branch,
                "the branch asked for at " + at_parameter(node_.p) + " was not found");
  };
  if (!crossing_) return fail();
  const double direction = choice == 2 ? crossing_->direction : -crossing_->direction;
  const PathPlane plane{direction * crossing_->plane.x, direction * crossing_->plane.p};
  const std::optional<Bridge> bridge = bridge_other_path(plane, node_);
  if (!bridge) return fail();
  plane_ = plane;
  direction_ = 1.0;
  bridge_ = *bridge;
  branch_.coordinate = coordinate(node_.path.x.col(0), node_.p);
  turned_step_ = 0.5 * std::abs(bridge_->end() - bridge_->begin());
  const PathPoint point = compute_point(problem_, predict(node_, 0.0), node_.basis.T[0], result_.counts);
  if (point.status != PointStatus::computed) return fail();
  std::optional<PathNode> node = differentiate_point(problem_, point, result_.counts);
  if (!node) return fail();
  for (std::size_t i = 0; i < node->tracks.size(); ++i) {
    Track& track = node->tracks[i];
    const Track& arrived = node_.tracks[i];
    track.roots = in_order_of(arrived.roots, track.roots);
    track.modes = track.arriving = arrived.arriving;
    if (track.size() == 1) continue;
    // Where eigenvalues meet, their order a little behind the point is the one that counts.
    const double distance = glimpse * turned_step_;
    track.departure = Track::Departure{
        distance, in_order_of(track.roots, block_roots(evaluate_series(track.functions, distance)))};
    if (track.pair.is_real) settle_real_block(track);
  }
  node_ = std::move(*node);
  ++result_.regroupings.planes;
  return true;
}

}  // namespace eigentrail
