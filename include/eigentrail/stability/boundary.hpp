// Stability boundaries in the plane of two parameters P and Q.
//
//   flutter        {Re s = 0} of a complex pair      tau = (s + conj s) / 2 = 0 with delta = -(Im s)^2 < 0
//   divergence     {s = 0}                           the tangent stiffness is singular
//   damping ratio  {-Re s / |s| = z}                 z^2 delta + (1 - z^2) tau^2 = 0 with tau z < 0
//
// Each left side g is a smooth function of (P, Q), also where the frequency of the pair vanishes (tau and
// delta: invariants.hpp) and where s = 0 is a double root. For divergence g solves the bordered system
//
//     [ K  b ] [ z ]   [ 0 ]
//     [ c' 0 ] [ g ] = [ 1 ]        (Griewank & Reddien, SIAM J. Numer. Anal. 21, 1984)
//
// with K the reduced stiffness. A curve is followed by pseudo-arclength (Keller 1977) with a power series at
// every point: in coordinates scaled by the window, (P, Q) = (P0, Q0) + u t + nu(u) n with the tangent t and
// the normal n = grad g / |grad g|, the coefficients of nu order by order from those of g.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/stability/boundary_options.hpp"

namespace eigentrail {

using Place = Eigen::Vector2d;  ///< P and Q

enum class BoundaryKind { flutter, divergence, damping_ratio };
std::string boundary_name(BoundaryKind kind);

/// How a curve begins or ends.
enum class CurveEnd {
  edge,               ///< on the edge of the window
  closed,             ///< it returns to its seed
  takens_bogdanov,    ///< the frequency reaches zero
  equilibrium_ends,   ///< a fold: no equilibrium beyond
  exceptional_point,  ///< its mode coalesces with another one
  lost                ///< it could not be followed any further; the reason is in words
};
std::string curve_end_name(CurveEnd end);

/// What is special about a point of a curve; one bit each.
enum PointFlag : int { seed_flag = 1, edge_flag = 2, takens_bogdanov_flag = 4 };

/// A point on a curve.
struct BoundaryPoint {
  Place place;     ///< P, Q in their units
  Place tangent;   ///< direction of the curve, of unit length where the window has side one; in their units
  Complex s;       ///< Im s >= 0
  int others = 0;  ///< modes beside this one that are unstable (less damped); a complex pair counts once
  ComplexVector shape;  ///< n, physical coordinates, unit M-norm, its largest component real and positive
  Vector equilibrium;   ///< n, coordinates
  int flags = 0;        ///< of PointFlag
};

/// The curve between two neighbouring points, as series in the distance along their chord.
struct BoundaryStep {
  double length = 0.0;  ///< of the chord where the window has side one
  Matrix left, right;   ///< 4 x (order + 1): P, Q, tau, delta at both ends; divergence has tau = delta = 0
};

/// P, Q, tau, delta at t in [0, 1].
Eigen::Vector4d evaluate_step(const BoundaryStep& step, double t);

struct BoundaryCurve {
  BoundaryKind kind = BoundaryKind::flutter;
  std::string mode;  ///< number of its mode by ascending |s| at its seed
  std::vector<BoundaryPoint> points;
  std::vector<BoundaryStep> steps;  ///< one less than points; a closed curve repeats its first point
  CurveEnd begin = CurveEnd::lost, end = CurveEnd::lost;
  std::string begin_reason, end_reason;  ///< in words where there is more to say

  bool closed() const { return end == CurveEnd::closed; }
  /// Smallest and largest P and Q, to the accuracy of the dense output.
  std::pair<Place, Place> extent() const;
};

enum class CornerKind {
  crossing,        ///< two curves cross: beyond it another mode is the first to become unstable
  takens_bogdanov  ///< a curve of complex pairs ends on one of divergence
};
std::string corner_name(CornerKind kind);

/// A point that belongs to two curves, or twice to one.
struct Corner {
  CornerKind kind = CornerKind::crossing;
  Place place;
  std::array<Complex, 2> s;
  std::array<int, 2> curves;  ///< from 0
};

enum class BoundaryStatus {
  completed,
  no_equilibrium,  ///< nowhere on the lines that were searched
  incomplete       ///< a curve was lost, or a change of stability could not be followed
};

struct [[nodiscard]] BoundaryResult {
  BoundaryStatus status = BoundaryStatus::completed;
  std::string message;             ///< reason when not completed, in words
  std::vector<std::string> notes;  ///< what the user should know, in words
  std::vector<BoundaryCurve> curves;
  std::vector<Corner> corners;
  double s_ref = 0.0;
  int lines = 0;    ///< traced
  int seeds = 0;    ///< changes of stability found on lines
  int walks = 0;    ///< from extrema on lines to those of the plane
  int islands = 0;  ///< seeds that only walks found
  int rejected_steps = 0;
  RunCounts counts;
  double seconds = 0.0;
};

/// Called now and then with the share of the work done, 0 to 1, and the number of points so far. Not called
/// by two threads at once.
using BoundaryProgress = std::function<void(double, int)>;

/// Looks for all boundaries in the window and follows them. Numerical outcomes are the status and notes of
/// the result. Costs a trace along every line, and at every point of a curve order + 3 differentiations of
/// one mode and one full spectrum. The model is used by several threads. Throws std::invalid_argument when
/// `model` lacks a parameter.
BoundaryResult find_boundaries(const Model& model, const BoundaryOptions& options,
                               const BoundaryProgress& progress = {});

}  // namespace eigentrail
