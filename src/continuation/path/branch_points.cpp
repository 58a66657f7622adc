#include "continuation/path/branch_points.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

#include "core/bisection.hpp"
#include "core/matrix_series.hpp"
#include "core/positive_or_one.hpp"
#include "core/products.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {
namespace {

/// In steps: distance inside an end of the step at which the test function is evaluated. At the end itself it
/// may be zero.
constexpr double within_step = 1e-3;
/// In steps: a branch point up to this far beyond the end gets a bridge, too, since the steady equations at
/// the end are nearly singular already.
constexpr double look_ahead = 0.3;
/// In steps: places at which the series of the left end is evaluated, besides the end of the step, if the
/// right end was not found. Two changes of sign between neighbouring places are not seen.
constexpr double first_place = 0.4, second_place = 0.7;
/// Half the length of the first bridge, as a share of the step. Shorter ones follow until one is accurate:
/// the polynomial of a long bridge has a larger truncation error, and the ends of a short one are so close to
/// the branch point that the nearly singular equations make them inaccurate.
constexpr double first_bridge = 0.25;
constexpr double shrinking = 0.6;  ///< ratio of the lengths of consecutive bridges
constexpr int most_lengths = 8;    ///< the last bridge has 0.03 times the length of the first
constexpr int most_tries = 3;      ///< attempts to build a bridge from one point
/// A bridge is replaced by a shorter one only if the error of that is at most this share of its own.
constexpr double much_better = 0.3;
/// As a share of the range: a projected scene has the zero of a followed mode this close to that of the
/// whole, and the branch point is where the followed mode has it. Farther away its own zero is that of a
/// motion that it knows little of. The error of a projection is about the square of that of its vectors,
/// below 1e-8.
constexpr double same_zero = 1e-6;
/// In half lengths of a bridge: if the root of the test function moves by more, the prediction was of another
/// point.
constexpr double farthest_root = 10.0;

/// Error of an entry of a reduced stiffness, in units of 2.2e-16 of the magnitudes of the terms that it is a
/// sum of. As RoundingThresholds::entries.
constexpr double roundings = 10.0;

/// A stiffness in reduced coordinates, the magnitudes of the terms that its entries are sums of, and the norm
/// of the whole: in its entries stiffnesses of elements may have cancelled, of which the terms tell nothing.
struct Stiffness {
  Matrix K, terms;
  double whole;
};

/// In coordinates in which the terms of the diagonal are one: stiffnesses of very different size, as those of
/// stretching and bending, do not hide each other. Without a sign if the smallest singular value there is at
/// most `margin` times the error by rounding.
LogDeterminant determinant_of(const Stiffness& stiffness, double margin) {
  if (stiffness.K.size() == 0) return {};
  const Vector scale = stiffness.terms.diagonal().unaryExpr(
      [](double term) { return term > 0.0 ? 1.0 / std::sqrt(term) : 1.0; });
  const auto norm = [](const Matrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); };
  const Matrix K = scale.asDiagonal() * stiffness.K * scale.asDiagonal();
  const double rounding = std::numeric_limits<double>::epsilon() *
                          (roundings * norm(scale.asDiagonal() * stiffness.terms * scale.asDiagonal()) +
                           stiffness.whole * scale.cwiseAbs2().maxCoeff());
  const Eigen::PartialPivLU<Matrix> lu(K);
  if (!(lu.rcond() * norm(K) > margin * rounding)) return {};
  LogDeterminant result{static_cast<double>(lu.permutationP().determinant()),
                        -2.0 * scale.array().log().sum()};
  for (const double pivot : lu.matrixLU().diagonal()) {
    result.sign *= pivot > 0.0 ? 1.0 : -1.0;
    result.logarithm += std::log(std::abs(pivot));
  }
  return result;
}

/// Freedoms that a force holds for some value of the parameter. The zero of the others is no branch point.
std::vector<Eigen::Index> held_freedoms(const IndependentParts& parts) {
  std::vector<Eigen::Index> held;
  for (Eigen::Index i = 0; i < parts.pattern_K.rows(); ++i) {
    if (!parts.pattern_K.row(i).isZero(0.0) || !parts.pattern_K.col(i).isZero(0.0)) held.push_back(i);
  }
  return held;
}

/// `K` in the coordinates of a basis, of the freedoms that are held. `whole`: the stiffness of which K is a
/// projection.
Stiffness held_stiffness(const Matrix& K, const TangentBasis& basis, const SystemMatrix& whole) {
  const double norm = whole.one_norm();
  if (basis.is_identity) return {K, whole.dense().cwiseAbs(), norm};
  if (!basis.parts) return {K, magnitudes_of_terms(basis.T[0], whole.dense(), basis.T[0]), norm};
  const IndependentParts& parts = *basis.parts;
  const std::vector<Eigen::Index> held = held_freedoms(parts);
  const Matrix terms = magnitudes_of_terms(parts.left, whole.dense(), parts.right);
  return {K(held, held), terms(held, held), norm};
}

Stiffness held_stiffness(const PathPoint& point) {
  return held_stiffness(point.pencil.K[0], point.basis, point.equilibrium.linearization.K[0]);
}

SystemMatrix evaluated(const SystemSeries& series, double h) {
  SystemMatrix sum = series[0];
  double power = h;
  for (std::size_t k = 1; k < series.size(); ++k, power *= h) sum.add_scaled(power, series[k]);
  return sum;
}

LogDeterminant of_the_whole(const SystemMatrix& K, const SystemMatrix& A) {
  const auto kkt = SparseKkt::factor(K.sparse(), A.sparse());
  return kkt ? kkt->determinant() : LogDeterminant();
}

/// The determinant at a point.
LogDeterminant stiffness_determinant(const PathProblem& problem, const PathPoint& point) {
  const Equilibrium& at = point.equilibrium;
  if (problem.model.projection() == nullptr) return determinant_of(held_stiffness(point), 1.0);
  return of_the_whole(at.linearization.K[0], at.linearization.A[0]);
}

/// The same at a distance from a point, by its series.
LogDeterminant stiffness_determinant(const PathProblem& problem, const PathNode& node, double distance) {
  const Linearization& at = node.linearization;
  if (problem.model.projection() == nullptr)
    return determinant_of(held_stiffness(evaluate_series(node.pencil.K, distance), node.basis, at.K[0]), 1.0);
  return of_the_whole(evaluated(at.K, distance), evaluated(at.A, distance));
}

/// det T^T K T of the freedoms that are held, also of a projected scene, up to the last digit and divided by
/// the magnitude of another one: for the search of its zero.
double vanishing_determinant(const PathPoint& point, const LogDeterminant& unit) {
  return determinant_of(held_stiffness(point), 0.0).relative_to(unit);
}

/// singularity_test (steady/) of the whole stiffness of a projected scene, for the search of its zero.
class WholeSingularity {
 public:
  /// Zero also if there is no kernel. The first point should be the one closest to the zero.
  double operator()(const PathPoint& point) {
    const SparseMatrix& K = point.equilibrium.linearization.K[0].sparse();
    const SparseMatrix& A = point.equilibrium.linearization.A[0].sparse();
    if (!kernel_) kernel_ = kkt_kernel(K, A);
    return kernel_ ? singularity_test(K, A, *kernel_) : 0.0;
  }

 private:
  std::optional<KktKernel> kernel_;  ///< at the first point
};

/// Whether forces hold any freedom of a point.
bool holds_anything(const PathPoint& point) {
  return !point.basis.parts || !held_freedoms(*point.basis.parts).empty();
}

/// Derivative of a row of a series at h.
double slope(const VectorSeries& series, Eigen::Index row, double h) {
  double value = 0.0;
  for (Eigen::Index k = series.cols() - 1; k > 0; --k)
    value = value * h + static_cast<double>(k) * series(row, k);
  return value;
}

/// Zero of the linear function that is a at 0 and b at 1.
double straight_root(double a, double b) {
  return a / (a - b);
}

/// Predicted distance of a branch point from `node`, up to a little beyond `next`, from a change of sign of
/// the test function. Empty if there is none.
std::optional<double> expect_branch_point(const PathProblem& problem, const PathFrame& frame,
                                          const PathNode& node, double h, const PathNode* next) {
  const int traced = frame.range.traced;
  const auto test = [&](const PathNode& there, double distance, double& divisor) {
    divisor = frame.plane ? slope(there.path.parameters, traced, distance) : 1.0;
    return stiffness_determinant(problem, there, distance);
  };
  double heading = 1.0;
  const LogDeterminant begin = test(node, within_step * h, heading);
  if (begin.sign == 0.0) return std::nullopt;
  std::array<std::pair<const PathNode*, double>, 4> places{
      {{&node, first_place}, {&node, second_place}, {&node, 1.0}, {&node, 1.0 + look_ahead}}};
  if (next != nullptr) places = {{{next, -within_step}, {next, look_ahead}}};
  double left = within_step;
  double at_left = 1.0 / heading;
  for (const auto& [there, distance] : places) {
    if (there == nullptr) break;
    double divisor = 1.0;
    const LogDeterminant value = test(*there, distance * h, divisor);
    const double at_right = value.relative_to(begin) * begin.sign / divisor;
    const double right = there == &node ? distance : 1.0 + distance;
    if (at_left * at_right < 0.0) return h * (left + (right - left) * straight_root(at_left, at_right));
    left = right;
    at_left = at_right;
  }
  return std::nullopt;
}

/// Place on a bridge where dp/dsigma vanishes, by bisection between its ends.
double turning_point(const Bridge& bridge, int traced, const SidePoint& left, const SidePoint& right) {
  constexpr int halvings = 80;  // more than the 53 bits of a double
  return bisected(
             left.coordinate, right.coordinate, halvings,
             [&](double sigma) { return bridge.path(sigma, 1).parameters(traced, 1) * left.heading > 0.0; })
      .last;
}

/// A root of a test function of the points on a bridge, by the secant method from `guess` and `other`. The
/// function is evaluated at the guess first.
template <class Test>
double root_on(const PointSolver& solver, const Matrix& basis, const Bridge& bridge, double guess,
               double other, Test&& test) {
  constexpr int most_secants = 20;
  constexpr double last_correction = 1e-15;  // relative: rounding of the coordinate
  const auto value = [&](double at) {
    const PathPoint point = reduce_on(solver.problem(), bridge.path(at, 1), basis, solver.counts());
    return point.status == PointStatus::computed ? test(point) : 0.0;
  };
  double b = guess;
  double at_b = value(b);
  double a = other;
  double at_a = value(a);
  for (int i = 0; i < most_secants && at_b != 0.0 && at_b != at_a; ++i) {
    const double next = b - at_b * (b - a) / (at_b - at_a);
    a = b;
    at_a = at_b;
    b = next;
    if (!bridge.covers(b) || std::abs(b - a) <= last_correction * std::abs(b)) break;
    at_b = value(b);
  }
  return b;
}

/// Coordinate of the branch point on a bridge: where the stiffness is singular. If p has an extremum there,
/// as on the bifurcating path of a pitchfork, its determinant has a double root, and the simple root of
/// dp/dsigma is used.
double locate_on(const PointSolver& solver, const Matrix& basis, const Bridge& bridge, const SidePoint& left,
                 const SidePoint& right, double guess) {
  constexpr double same_turn = 0.2;  // of the bridge: an extremum of p farther away is another point
  const PathFrame& frame = solver.frame();
  if (frame.plane && left.heading * right.heading < 0.0) {
    const double turn = turning_point(bridge, solver.problem().traced, left, right);
    if (std::abs(turn - guess) < same_turn * std::abs(bridge.end() - bridge.begin())) return turn;
  }
  const bool is_projected = solver.problem().model.projection() != nullptr;
  const double whole =
      is_projected ? root_on(solver, basis, bridge, guess, left.coordinate, WholeSingularity()) : guess;
  const double own = root_on(solver, basis, bridge, whole, left.coordinate, [&](const PathPoint& point) {
    return vanishing_determinant(point, left.stiffness);
  });
  return is_projected && !(std::abs(own - whole) <= same_zero * frame.range.length()) ? whole : own;
}

/// The side point at a distance from `node`.
std::optional<SidePoint> side_point_at(const PointSolver& solver, const PathNode& node, double distance) {
  return side_point(solver, solver.reduce(node, distance), node.pencil.size());
}

/// Moves a branch point that is at an end of the range up to rounding exactly to that end.
void settle_on_ends(PathFrame& frame) {
  for (const double end : {frame.range.from, frame.range.to}) {
    const double scale = std::max(frame.range.length(), std::abs(end));
    if (std::abs(frame.branch_point.p - end) > same_coordinate * scale) continue;
    frame.branch_point.p = end;
    if (!frame.plane) frame.branch_point.coordinate = end;
  }
}

/// Builds a bridge in the frame over the branch point predicted at the distance `guess` from `node`, on a
/// step of length h. Takes the first bridge with an error of at most `good_bridge`; if there is none, the
/// best one up to `fair_bridge`. False if there is none.
bool build_bridge(const PointSolver& solver, PathFrame& frame, const PathNode& node, double guess, double h) {
  const int traced = frame.range.traced;
  const double origin = frame.coordinate(node);
  double half = first_bridge * h;
  double best = fair_bridge;
  std::optional<Bridge> found;
  double located = 0.0;
  for (int i = 0; i < most_lengths && best > good_bridge; ++i, half *= shrinking) {
    const std::optional<SidePoint> left = side_point_at(solver, node, guess - half);
    const std::optional<SidePoint> right = side_point_at(solver, node, guess + half);
    if (!left || !right) continue;
    const double ratio =
        right->stiffness.relative_to(left->stiffness) / left->stiffness.sign * left->heading / right->heading;
    const double root = guess + half * (2.0 * straight_root(1.0, ratio) - 1.0);
    if (!std::isfinite(root) || std::abs(root - guess) > farthest_root * std::abs(half)) break;
    guess = root;
    if (!(ratio < 0.0)) continue;
    const Bridge bridge(left->coordinate, right->coordinate, left->path, right->path, traced,
                        frame.plane.has_value());
    const double error = bridge.error(bridge_sizes(frame, node));
    if (error > best || (found && error > much_better * best)) continue;
    const double place = locate_on(solver, node.basis.T[0], bridge, *left, *right, origin + guess);
    if (!bridge.covers(place)) continue;
    found = bridge;
    located = place;
    best = error;
    guess = located - origin;
  }
  if (!found) return false;
  frame.bridge = found;
  frame.branch_point = {located, found->path(located, 1).parameters(traced, 0)};
  settle_on_ends(frame);
  return true;
}

/// Whether paths may cross where a mode of the pencil is zero. With trimmed parameters such a mode is one of
/// motion with these parameters held, and the path goes on.
bool may_branch(const PathProblem& problem) {
  return problem.model.n_trims() == 0 && equilibrium_moves(problem);
}

}  // namespace

bool equilibrium_moves(const PathProblem& problem) {
  return !problem.structure.fixed_equilibrium && !problem.structure.known_equilibrium;
}

Bridge::Sizes bridge_sizes(const PathFrame& frame, const PathNode& node) {
  const PathScales scales = frame.scales();
  const double force = positive_or_one(node.linearization.K[0].largest_entry() * scales.x);
  const Vector rows = node.linearization.A[0].row_norms();
  return {scales.x, rows.size() > 0 ? force / positive_or_one(rows.maxCoeff()) : 1.0, scales.p};
}

std::optional<SidePoint> side_point(const PointSolver& solver, const PathPoint& point,
                                    Eigen::Index n_freedoms) {
  if (point.status != PointStatus::computed || point.pencil.size() != n_freedoms) return std::nullopt;
  SidePoint side;
  if (equilibrium_series(solver.problem(), point, max_order, side.path, solver.counts())) return std::nullopt;
  if (!side.path.x.allFinite() || !side.path.lambda.allFinite()) return std::nullopt;
  side.coordinate =
      point.plane ? (*point.plane)(point.equilibrium.x, point.equilibrium.lambda, point.p) : point.p;
  side.heading = coefficient(side.path.parameters, solver.problem().traced, 1);
  side.stiffness = stiffness_determinant(solver.problem(), point);
  return side;
}

bool bridge_branch_point(const PointSolver& solver, PathFrame& frame, const PathNode& node, double h,
                         const PathNode* next, int& tries) {
  if (!may_branch(solver.problem()) || node.pencil.size() == 0 || tries >= most_tries) return false;
  // A step that begins or ends on a bridge leads over a branch point that is known.
  const double here = frame.coordinate(node);
  if (frame.bridge && (frame.bridge->covers(here) || frame.bridge->covers(here + h))) return false;
  const StageTimer timer(solver.counts().events_seconds);
  const std::optional<double> expected = expect_branch_point(solver.problem(), frame, node, h, next);
  if (!expected) return false;
  ++tries;
  return build_bridge(solver, frame, node, *expected, h);
}

bool is_on_branch_point(const PathProblem& problem, const PathPoint& point) {
  return may_branch(problem) && holds_anything(point) && stiffness_determinant(problem, point).sign == 0.0;
}

std::optional<PathPoint> bridge_start(const PointSolver& solver, PathFrame& frame, const PathPoint& point) {
  const PathProblem& problem = solver.problem();
  if (!is_on_branch_point(problem, point)) return std::nullopt;
  const std::optional<PathNode> node = differentiate_point(problem, point, solver.counts());
  if (!node) return std::nullopt;
  note_size(problem.model, *node, frame);
  const double from = frame.range.from;
  const double first = first_bridge * frame.direction * frame.range.length();
  if (!build_bridge(solver, frame, *node, 0.0, first) || !frame.on_branch_point(from)) {
    frame.bridge.reset();
    return std::nullopt;
  }
  return reduce_on(problem, frame.bridge->path(from, problem.order + 1), point.basis.T[0], solver.counts());
}

}  // namespace eigentrail
