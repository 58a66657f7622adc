#include "eigentrail/continuation/eigenvalue_error.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Relative rounding error of the matrix of a block at a stored point.
constexpr double function_rounding_level = 1e-13;
/// A trace promises its tolerance for eigenvalues of a block that are this far apart, relatively.
constexpr double promised_gap = 0.1;

/// Error bounds of the functions of a block (invariants.hpp) at a place on a step. At a stored point
/// (`at_node`) they are rounding errors.
Vector function_errors(const HermiteInterpolant& dense, const ComplexVector& functions, bool at_node,
                       double scale, double tolerance) {
  const Eigen::Index k = block_size(functions.size());
  // An error e of Lambda changes tau and the entries of Lambda by e, and delta by about e |Lambda - tau I|.
  // That norm is estimated by the largest sqrt(|delta|) on the step. If the largest |delta| is itself within
  // the rounding error of s^2, delta is entirely unknown.
  Vector errors = Vector::Constant(functions.size(), function_rounding_level * scale);
  if (k == 2) {
    double largest = 0.0;
    for (const double t : {0.0, 0.5, 1.0}) largest = std::max(largest, std::abs(dense(t)[1]));
    errors[1] *= std::sqrt(largest);
    if (largest <= function_rounding_level * scale * scale) errors[1] += largest;
  }
  if (at_node) return errors;
  // error_without_last() belongs to the interpolant of one order less and so overestimates the error. The
  // step control has kept the error within the tolerance. The smaller of the two bounds holds.
  Vector promised = Vector::Constant(functions.size(), tolerance * scale / static_cast<double>(k));
  if (k == 2) promised << tolerance * scale, tolerance * promised_gap * scale * scale;
  return errors + dense.error_without_last().cwiseMin(promised);
}

}  // namespace

Complex shown(Complex s, double rounding) {
  if (!std::isfinite(std::abs(s))) return s;
  if (std::abs(s) <= rounding) return 0.0;
  return std::abs(s.real()) <= rounding ? Complex(0.0, s.imag()) : s;
}

Vector block_errors(const DenseBlock& block, double length, double t, const ComplexVector& s, bool at_node,
                    double tolerance, double reference) {
  const HermiteInterpolant dense(length, block.left, block.right);
  const ComplexVector functions = dense(t);
  const ComplexVector roots = block_roots(functions);
  const double scale = std::max(roots.cwiseAbs().maxCoeff(), reference);
  const Vector errors =
      root_errors(functions, roots, function_errors(dense, functions, at_node, scale, tolerance));
  Vector result(static_cast<Eigen::Index>(block.modes.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const Complex own = s[block.modes[static_cast<std::size_t>(i)]];
    const Complex root = chart_value(own, block.chart);
    Eigen::Index nearest = 0;
    (roots.array() - root).abs().min((roots.array() - std::conj(root)).abs()).minCoeff(&nearest);
    const double of_s = block.chart == Chart::finite ? 1.0 : std::norm(own);
    result[i] = errors[nearest] * of_s;
  }
  return result;
}

}  // namespace eigentrail
