// Stability boundaries in the plane of two parameters P and Q.
//
//   flutter        {Re s = 0} of a complex pair      tau = (s + conj s) / 2 = 0 with delta = -(Im s)^2 < 0
//                  of modes without damping: two pairs i w1, i w2 meet and leave the imaginary axis
//                                                    (i w1 - i w2)^2 / 4 = 0, a coalescence
//   divergence     {s = 0}                           the tangent stiffness is singular
//   damping ratio  {-Re s / |s| = z}                 z^2 delta + (1 - z^2) tau^2 = 0 with tau z < 0
//
// tau and delta are the mean and the squared half difference of the pair (invariants.hpp). Each equation has
// the form g(P, Q) = 0 with a smooth function g, also where the frequency of the pair vanishes and where
// s = 0 is a double root. For divergence g solves the bordered system
//
//     [ K  b ] [ z ]   [ 0 ]
//     [ c' 0 ] [ g ] = [ 1 ]        (Griewank & Reddien, SIAM J. Numer. Anal. 21, 1984)
//
// with K the reduced stiffness, and b and c close to its left and right null vectors. A curve is followed by
// pseudo-arclength continuation (Keller 1977) with a power series at every point. In coordinates scaled by
// the window, (P, Q) = (P0, Q0) + u t + nu(u) n with the tangent t and the normal n = grad g / |grad g|. The
// coefficients of nu follow from those of g order by order.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/core/workers.hpp"
#include "eigentrail/stability/boundary_options.hpp"

namespace eigentrail {

using Place = Eigen::Vector2d;  ///< a point of the parameter plane: P and Q

/// A coalescence is a flutter of modes without damping; its tau and delta are those of the pair that both
/// become.
enum class BoundaryKind { flutter, divergence, damping_ratio, coalescence };
/// That of a coalescence is "flutter".
std::string boundary_name(BoundaryKind kind);

/// How a curve begins or ends.
enum class CurveEnd {
  edge,               ///< on the edge of the window
  closed,             ///< it returns to its starting point (seed)
  takens_bogdanov,    ///< the frequency of the pair reaches zero
  equilibrium_ends,   ///< the equilibrium folds or does not exist beyond
  exceptional_point,  ///< its mode coalesces with another one
  lost                ///< it could not be followed further; the reason is given in words
};
std::string curve_end_name(CurveEnd end);

/// Marks of a point of a curve, one bit each: starting point, point on the edge of the window,
/// Takens-Bogdanov point.
enum PointFlag : int { seed_flag = 1, edge_flag = 2, takens_bogdanov_flag = 4 };

/// A point on a curve.
struct BoundaryPoint {
  Place place;     ///< P, Q in their units
  Place tangent;   ///< direction of the curve in the units of P and Q; unit length in the scaled window
  Complex s;       ///< eigenvalue on the boundary, 1/s; Im s >= 0
  int others = 0;  ///< other modes that are unstable, or damped less than asked; a complex pair counts once
  ComplexVector shape;  ///< n, physical coordinates, unit M-norm, its largest component real and positive
  Vector equilibrium;   ///< n, equilibrium coordinates
  int flags = 0;        ///< sum of PointFlag
};

/// The curve between two neighbouring points, as power series at both in the distance along their chord.
struct BoundaryStep {
  double length = 0.0;  ///< of the chord in the scaled window, whose sides are 1
  Matrix left, right;   ///< 4 x (order + 1): P, Q, tau, delta at both ends; divergence has tau = delta = 0
};

/// The same from the rows of a boundary file, 4 x 2 x `orders`: of each function the series at both ends.
BoundaryStep boundary_step(double length, const double* series, Eigen::Index orders);

/// P, Q, tau, delta at t in [0, 1] along the chord; s = tau + sqrt(delta).
Eigen::Vector4d evaluate_step(const BoundaryStep& step, double t);

struct BoundaryCurve {
  BoundaryKind kind = BoundaryKind::flutter;
  std::string mode;  ///< "mode N": N counts the modes by ascending |s| at the curve's starting point, from 1
  std::vector<BoundaryPoint> points;
  std::vector<BoundaryStep> steps;  ///< one less than points; a closed curve repeats its first point
  CurveEnd begin = CurveEnd::lost, end = CurveEnd::lost;
  std::string begin_reason, end_reason;  ///< explanation in words; empty if the end needs none

  bool closed() const { return end == CurveEnd::closed; }
  /// Smallest and largest P and Q on the curve, turning points between the points included; to the accuracy
  /// of the dense output.
  std::pair<Place, Place> extent() const;
};

enum class CornerKind {
  intersection,    ///< of two curves: beyond it another mode is the first to become unstable
  takens_bogdanov  ///< a curve of complex pairs ends on one of divergence
};
std::string corner_name(CornerKind kind);

/// A point that belongs to two curves, or at which a curve intersects itself.
struct Corner {
  CornerKind kind = CornerKind::intersection;
  Place place;                ///< P, Q in their units
  std::array<Complex, 2> s;   ///< eigenvalues of the two curves, 1/s; Im s >= 0
  std::array<int, 2> curves;  ///< numbers of the curves, from 0
};

enum class BoundaryStatus {
  completed,
  no_equilibrium,  ///< the trace of no line could be started
  incomplete       ///< a curve was lost, or could not be started at a change of stability
};

struct [[nodiscard]] BoundaryResult {
  BoundaryStatus status = BoundaryStatus::completed;
  std::string message;             ///< reason when not completed, in words
  std::vector<std::string> notes;  ///< restrictions and findings that the user should know, in words
  std::vector<BoundaryCurve> curves;
  std::vector<Corner> corners;
  double s_ref = 0.0;  ///< reference of relative errors, 1/s
  int lines = 0;       ///< lines traced
  int seeds = 0;       ///< changes of stability found on lines
  int walks = 0;       ///< extrema on lines that were followed over the plane
  int islands = 0;     ///< curves that only such a walk found
  int rejected_steps = 0;
  RunCounts counts;
  double seconds = 0.0;  ///< wall time
};

/// Called during the search with the share of the work done, 0 to 1, and the number of points so far. Calls
/// do not overlap.
using BoundaryProgress = std::function<void(double, int)>;

/// Searches the window for boundaries and follows them. Numerical failures are not thrown; they are reported
/// in the status and notes of the result. Cost: one trace per line, and per point of a curve order + 3
/// differentiations of one mode and one full spectrum. Several threads use the model at the same time. Throws
/// std::invalid_argument if `model` lacks a parameter.
BoundaryResult find_boundaries(const Model& model, const BoundaryOptions& options,
                               const BoundaryProgress& progress = {});

// The two halves of find_boundaries, for other workers than the threads of this process, and for searches
// whose lines are shared among machines. The second half needs what the first found on all lines. The result
// does not depend on the workers.

/// Number of lines of the window that are searched, the edges included.
std::size_t boundary_lines(const BoundaryOptions& options);

/// What is found on the lines with these numbers, counted from 0, as bytes.
std::vector<std::string> scan_boundaries(const Model& model, const BoundaryOptions& options,
                                         const std::vector<std::size_t>& lines, Workers& workers,
                                         const BoundaryProgress& progress = {});

/// Follows the boundaries from what scan_boundaries has found on all lines, in order. Throws InputError if
/// that is damaged.
BoundaryResult follow_boundaries(const Model& model, const BoundaryOptions& options,
                                 const std::vector<std::string>& scans, Workers& workers,
                                 const BoundaryProgress& progress = {});

}  // namespace eigentrail
