// Where another equilibrium path crosses: the trace builds a bridge over the point and ends a step on it.
//
// Test function: det of the bordered steady equations changes its sign at a branch point, and at none of the
// folds. In the path's coordinate it is det(T^T K T) / (dp / dsigma), of which a node has series.
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"
#include "core/matrix_series.hpp"
#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

constexpr double within_step = 1e-3;  ///< of a step: how far inside it the test function is looked at
constexpr double look_ahead = 0.3;    ///< of a step: a branch point this near to its end is bridged, too
constexpr double regular = 1e-11;     ///< a stiffness of smaller reciprocal condition has no sign
constexpr double first_bridge =
    0.25;                        ///< of a step: half the length of a bridge, which is halved until it fits
constexpr int most_bridges = 8;  ///< that are tried at one place
constexpr double same_point = 1e-12;  ///< coordinates this close, relatively, are one

/// Sign and logarithm of a determinant: of large matrices the number itself may overflow.
struct Determinant {
  double sign = 0.0;  ///< 0: singular to rounding
  double logarithm = 0.0;

  /// `scale` is the magnitude of what the matrix is the projection of.
  Determinant(const Matrix& matrix, double scale) {
    const Eigen::PartialPivLU<Matrix> lu(matrix);
    if (!(lu.rcond() * norm(matrix) > regular * scale)) return;
    sign = lu.permutationP().determinant();
    for (const double pivot : lu.matrixLU().diagonal()) {
      sign *= pivot > 0.0 ? 1.0 : -1.0;
      logarithm += std::log(std::abs(pivot));
    }
  }
  static double norm(const Matrix& matrix) { return matrix.cwiseAbs().colwise().sum().maxCoeff(); }
  double relative_to(const Determinant& other) const { return sign * std::exp(logarithm - other.logarithm); }
};

double slope(const VectorSeries& series, Eigen::Index row, double h) {
  double value = 0.0;
  for (Eigen::Index k = series.cols() - 1; k > 0; --k)
    value = value * h + static_cast<double>(k) * series(row, k);
  return value;
}

/// Where a function that is a at 0 and b at 1 is zero, if it is straight.
double straight_root(double a, double b) {
  return a / (a - b);
}

}  // namespace

double Tracer::coordinate(const Vector& x, double p) const {
  return plane_ ? (*plane_)(x, p) : p;
}

bool Tracer::on_branch_point(double coordinate) const {
  return bridge_ && std::abs(coordinate - branch_.coordinate) <= same_point * (plane_ ? 1.0 : range());
}

/// Where a branch point is expected between the last point and a little behind `next`, which may be missing:
/// then the series of the last point alone tells.
std::optional<double> Tracer::expect_branch_point(double h, const PathNode* next) const {
  const auto test = [&](const PathNode& node, double distance, double& divisor) {
    divisor = plane_ ? slope(node.path.parameters, problem_.traced, distance) : 1.0;
    return Determinant(evaluate_series(node.pencil.K, distance), node.linearization.K[0].one_norm());
  };
  double heading = 1.0;
  const Determinant begin = test(node_, within_step * h, heading);
  if (begin.sign == 0.0) return std::nullopt;
  std::array<std::pair<const PathNode*, double>, 4> places{
      {{&node_, 0.4}, {&node_, 0.7}, {&node_, 1.0}, {&node_, 1.3}}};
  if (next != nullptr) places = {{{next, -within_step}, {next, look_ahead}}};
  double left = within_step;
  double at_left = 1.0 / heading;
  for (const auto& [node, distance] : places) {
    if (node == nullptr) break;
    double divisor = 1.0;
    const Determinant there = test(*node, distance * h, divisor);
    const double at_right = there.relative_to(begin) * begin.sign / divisor;
    const double right = node == &node_ ? distance : 1.0 + distance;
    if (at_left * at_right < 0.0) return h * (left + (right - left) * straight_root(at_left, at_right));
    left = right;
    at_left = at_right;
  }
  return std::nullopt;
}

/// The path at a solved point, with as many coefficients as there are; nothing about modes.
std::optional<Tracer::Anchor> Tracer::anchor_at(const PathPoint& point) {
  if (point.status != PointStatus::computed || point.pencil.size() != node_.pencil.size())
    return std::nullopt;
  Anchor anchor;
  if (equilibrium_series(problem_, point, max_order, anchor.path, result_.counts)) return std::nullopt;
  if (!anchor.path.x.allFinite() || !anchor.path.lambda.allFinite()) return std::nullopt;
  anchor.coordinate = point.plane ? (*point.plane)(point.equilibrium.x, point.p) : point.p;
  anchor.heading = coefficient(anchor.path.parameters, problem_.traced, 1);
  const Determinant stiffness(point.pencil.K[0], point.equilibrium.linearization.K[0].one_norm());
  anchor.sign = stiffness.sign;
  anchor.logarithm = stiffness.logarithm;
  return anchor;
}

/// The path at a distance from the last point.
std::optional<Tracer::Anchor> Tracer::anchor(double distance) {
  const Prediction prediction = predict(node_, distance);
  const PathPoint point = reduce_at(problem_, prediction.p, prediction.equilibrium, node_.basis.T[0],
                                    result_.counts, prediction.plane);
  return anchor_at(point);
}

/// Multipliers count by their forces.
Bridge::Sizes Tracer::bridge_sizes() {
  const double length = path_scales().x;
  const double force = positive_or_one(node_.linearization.K[0].largest_entry() * length);
  const Vector rows = node_.linearization.A[0].row_norms();
  return {length, rows.size() > 0 ? force / positive_or_one(rows.maxCoeff()) : 1.0, range()};
}

/// Builds a bridge over the branch point that is expected at a distance from the last point.
bool Tracer::build_bridge(double guess, double h) {
  const double origin = coordinate(node_.path.x.col(0), node_.p);
  double half = first_bridge * h;
  double best = fair_bridge;
  bool found = false;
  for (int i = 0; i < most_bridges; ++i, half *= 0.6) {
    const std::optional<Anchor> left = anchor(guess - half);
    const std::optional<Anchor> right = anchor(guess + half);
    if (!left || !right) continue;
    const double ratio = right->sign * std::exp(right->logarithm - left->logarithm) / left->sign *
                         left->heading / right->heading;
    const double root = guess + half * (2.0 * straight_root(1.0, ratio) - 1.0);
    if (!std::isfinite(root) || std::abs(root - guess) > 10.0 * std::abs(half)) return found;
    guess = root;
    if (!(ratio < 0.0)) continue;
    const Bridge bridge(left->coordinate, right->coordinate, left->path, right->path, problem_.traced,
                        plane_.has_value());
    const double error = bridge.error(bridge_sizes());
    if (error > best || (found && error > 0.3 * best)) continue;
    const double located = locate_on(bridge, *left, *right, origin + guess);
    if (!bridge.covers(located)) continue;
    bridge_ = bridge;
    branch_.coordinate = located;
    found = true;
    best = error;
    guess = located - origin;
    if (error <= good_bridge) break;
  }
  if (found) branch_.p = bridge_->path(branch_.coordinate, 1).parameters(problem_.traced, 0);
  // A path that begins or ends in its branch point does so there, not beside it by a rounding.
  for (const double end : {options_.from, options_.to}) {
    if (!found || std::abs(branch_.p - end) > same_point * std::max(range(), std::abs(end))) continue;
    branch_.p = end;
    if (!plane_) branch_.coordinate = end;
  }
  return found;
}

/// The trace may begin on a branch point: then on the path that passes it in p.
void Tracer::bridge_start(PathPoint& point) {
  const bool moves = !problem_.structure.fixed_equilibrium && !problem_.structure.known_equilibrium;
  if (!moves || point.pencil.size() == 0) return;
  const double scale = point.equilibrium.linearization.K[0].one_norm();
  if (Determinant(point.pencil.K[0], scale).sign != 0.0) return;
  std::optional<PathNode> node = differentiate_point(problem_, point, result_.counts);
  if (!node) return;
  node_ = std::move(*node);
  if (!build_bridge(0.0, first_bridge * direction_ * range()) || !on_branch_point(options_.from)) {
    bridge_.reset();
    return;
  }
  point =
      reduce_on(problem_, bridge_->path(options_.from, problem_.order + 1), point.basis.T[0], result_.counts);
}

/// The branch point on a bridge. Where p turns on it dp/dsigma has a simple root there and det K a double
/// one; elsewhere det K has a simple one.
double Tracer::locate_on(const Bridge& bridge, const Anchor& left, const Anchor& right, double guess) {
  constexpr int halvings = 80;
  constexpr int most_secants = 20;
  if (plane_ && left.heading * right.heading < 0.0) {
    double a = left.coordinate;
    double b = right.coordinate;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (a + b);
      (bridge.path(middle, 1).parameters(problem_.traced, 1) * left.heading > 0.0 ? a : b) = middle;
    }
    if (std::abs(a - guess) < 0.2 * std::abs(bridge.end() - bridge.begin())) return a;
  }
  const auto stiffness = [&](double at) {
    const PathPoint point = reduce_on(problem_, bridge.path(at, 1), node_.basis.T[0], result_.counts);
    if (point.status != PointStatus::computed) return 0.0;
    const Determinant there(point.pencil.K[0], 0.0);
    return there.sign * std::exp(there.logarithm - left.logarithm);
  };
  double a = left.coordinate;
  double at_a = left.sign;
  double b = guess;
  double at_b = stiffness(b);
  for (int i = 0; i < most_secants && at_b != 0.0 && at_b != at_a; ++i) {
    const double next = b - at_b * (b - a) / (at_b - at_a);
    a = b;
    at_a = at_b;
    b = next;
    if (!bridge.covers(b) || std::abs(b - a) <= 1e-15 * std::abs(b)) break;
    at_b = stiffness(b);
  }
  return b;
}

/// The spectrum where the bridge ends; nothing when it has no modes.
std::optional<Spectrum> Tracer::spectrum_beside_branch_point() {
  const PathPoint point =
      reduce_on(problem_, bridge_->path(bridge_->end(), 1), node_.basis.T[0], result_.counts);
  if (point.status != PointStatus::computed) return std::nullopt;
  ++result_.counts.spectra;
  Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete || spectrum.modes.empty()) return std::nullopt;
  return spectrum;
}

/// Looks for a branch point on the step, or just behind it, and builds a bridge over it. Returns whether
/// there is a new one: then the step is to be taken again.
bool Tracer::bridge_branch_point(double h, const PathNode* next) {
  const bool moves = !problem_.structure.fixed_equilibrium && !problem_.structure.known_equilibrium;
  if (!moves || node_.pencil.size() == 0 || bridges_tried_ > 2) return false;
  const double here = coordinate(node_.path.x.col(0), node_.p);
  // On the bridge nothing has to be looked for.
  if (bridge_ && (bridge_->covers(here) || bridge_->covers(here + h))) return false;
  const StageTimer timer(result_.counts.events_seconds);
  const std::optional<double> expected = expect_branch_point(h, next);
  if (!expected) return false;
  ++bridges_tried_;
  return build_bridge(*expected, h);
}

/// Newton's method may arrive on another path. Between two points of one the terms of the interpolant of x
/// fall; over a jump they stay as large as it.
Tracer::Trouble Tracer::check_path(double h, const PathNode& next) const {
  constexpr double share = 0.1;        // of the way from one point to the other
  constexpr double negligible = 1e-6;  // of the largest position
  if (problem_.structure.fixed_equilibrium || problem_.structure.known_equilibrium) return {};
  if (node_.path.x.cols() < 3 || next.path.x.cols() != node_.path.x.cols()) return {};
  const HermiteInterpolant x(h, node_.path.x.cast<Complex>(), next.path.x.cast<Complex>());
  const double error = x.error_without_last().norm();
  const double way = (next.path.x.col(0) - node_.path.x.col(0)).norm();
  const double largest = std::max(largest_position_, node_.path.x.col(0).norm());
  if (error <= share * way + negligible * largest) return {};
  return {Trouble::Kind::no_equilibrium, -1, INFINITY, "the equilibrium found lies on another path"};
}

/// On the bridge the path is known; nothing is solved.
void Tracer::keep_to_bridge(Prediction& prediction) const {
  const double here = coordinate(prediction.equilibrium.x, prediction.p);
  if (!bridge_->covers(here)) return;
  const bool at_branch = on_branch_point(here);
  prediction.known = bridge_->path(at_branch ? branch_.coordinate : here, problem_.order + 1);
  double& p = prediction.known->parameters(problem_.traced, 0);
  if (at_branch) p = branch_.p;
  prediction.p = p;
}

/// How far the branch point is ahead of the last point; infinite when there is none.
double Tracer::distance_to_branch_point() const {
  if (!bridge_) return std::numeric_limits<double>::max();
  const double here = coordinate(node_.path.x.col(0), node_.p);
  const double ahead = direction_ * (branch_.coordinate - here);
  return on_branch_point(here) || ahead < 0.0 ? std::numeric_limits<double>::max() : ahead;
}

void Tracer::record_branch_point(const PathNode& node) {
  if (!on_branch_point(coordinate(node.path.x.col(0), node.p))) return;
  Event event;
  event.kind = EventKind::pitchfork;
  event.p = branch_.p;
  event.retrackings = 1;
  event.node = result_.nodes;
  keep_vanishing_mode(node, event);
  event.modes.clear();  // of this path; the other one has them, too
  add_event(std::move(event));
  survey_branch_point(node);
}

}  // namespace eigentrail
