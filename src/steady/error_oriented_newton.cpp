#include "steady/error_oriented_newton.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Changes of the damping in one iteration after which a step that leads closer is taken as it is.
constexpr int most_changes = 8;

/// The corrections and their sizes.
class Corrections {
 public:
  Corrections(const NonlinearProblem& problem, Eigen::Index measured)
      : problem_(problem), measured_(measured) {}

  double size(const Vector& du) const {
    return problem_.u_scale.head(measured_).cwiseProduct(du.head(measured_)).norm();
  }
  /// -J^-1 F(u) with the Jacobian that was factored last; false if F or the solution is not finite.
  bool at(const Vector& u, Vector& du) const {
    Vector f;
    if (!problem_.residual(u, f)) return false;
    problem_.solve(-f, du);
    return du.allFinite();
  }

 private:
  const NonlinearProblem& problem_;
  Eigen::Index measured_;
};

}  // namespace

NonlinearResult solve_error_oriented(const NonlinearProblem& problem, Eigen::Index measured,
                                     const ErrorOrientedOptions& options, Vector& u) {
  const Corrections corrections(problem, measured);
  NonlinearResult result;
  Vector du, simplified, before;  // the last one: the simplified correction that led here
  double damping = 1.0, length_before = 0.0;
  for (; result.iterations < options.max_iterations; ++result.iterations) {
    if (!problem.factor(u) || !corrections.at(u, du)) {
      result.message = "a correction is not finite";
      return result;
    }
    const double length = corrections.size(du);
    if (length <= options.tolerance) {
      u += du;
      result.converged = true;
      return result;
    }
    if (before.size() > 0) {
      // How much the Jacobian changed on the last step says how far its linear model holds.
      const double curvature = corrections.size(before - du) * length;
      const double foreseen = length_before * corrections.size(before) / curvature * damping;
      damping = std::isfinite(foreseen) ? std::clamp(foreseen, options.least_damping, 1.0) : 1.0;
    }
    for (int changes = 0;; ++changes) {
      if (damping < options.least_damping) {
        result.message = "no step along the correction leads closer to a solution";
        return result;
      }
      const bool finite = corrections.at(u + damping * du, simplified);
      const double next = finite ? corrections.size(simplified) : INFINITY;
      const double bend = finite ? corrections.size(simplified - (1.0 - damping) * du) : INFINITY;
      const double foreseen = finite ? 0.5 * length * damping * damping / bend : 0.0;
      if (!(next <= (1.0 - 0.25 * damping) * length)) {
        damping = std::min(foreseen, 0.5 * damping);
        continue;
      }
      const double longer = std::min(1.0, foreseen);
      if (changes >= most_changes || longer < 4.0 * damping) break;
      damping = longer;
    }
    u += damping * du;
    before = simplified;
    length_before = length;
  }
  result.message = "still moving after " + std::to_string(result.iterations) + " iterations";
  return result;
}

}  // namespace eigentrail
