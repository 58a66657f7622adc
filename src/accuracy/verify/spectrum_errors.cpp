#include "accuracy/verify/spectrum_errors.hpp"

#include <algorithm>
#include <cmath>

#include "accuracy/spectrum_distance.hpp"
#include "eigentrail/continuation/eigenvalue_error.hpp"

namespace eigentrail {
namespace {

/// The eigenvalues, and of pairs within rounding of the real axis, or zero to `zero`, both members: two equal
/// real eigenvalues may come as such a pair. Of two that may be one, which rounding has split, their mean as
/// well: it is known to rounding, they only to its root.
std::vector<Complex> with_double_roots(const std::vector<Complex>& exact, double zero) {
  constexpr double rounding_of_double_root = 1e-7;  // root of rounding times a few
  std::vector<Complex> result = exact;
  for (const Complex s : exact) {
    if (s.imag() != 0.0 &&
        (std::abs(s) <= zero || std::abs(s.imag()) <= rounding_of_double_root * std::abs(s)))
      result.push_back(std::conj(s));
  }
  const std::size_t all = result.size();
  for (std::size_t i = 0; i < all; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (std::abs(result[i] - result[j]) <= rounding_of_double_root * std::abs(result[i]))
        result.insert(result.end(), 2, 0.5 * (result[i] + result[j]));  // for both
    }
  }
  return result;
}

/// A place on its step; a stored point on the steps at both sides.
std::vector<PathPosition> sides_of(const RecordedPath& path, const PathPosition& position) {
  if (path.steps.empty()) return {};
  if (position.t == 0.0 && position.step > 0) return {{position.step - 1, 1.0}, position};
  if (position.t == 1.0 && position.step + 1 < path.steps.size()) return {position, {position.step + 1, 0.0}};
  return {position};
}

}  // namespace

Vector eigenvalue_errors(const RecordedPath& path, const PathPosition& position, const ComplexVector& s,
                         double level, const EigenvalueAccuracy& accuracy) {
  const auto [tolerance, reference] = accuracy;
  Vector errors = level * s.cwiseAbs().cwiseMax(reference);
  for (const PathPosition& side : sides_of(path, position)) {
    const PathStep& step = path.steps[side.step];
    const bool at_node = side.t == 0.0 || side.t == 1.0;
    for (const DenseBlock& block : step.blocks) {
      for (const std::size_t node : {side.step, side.step + 1}) {
        for (const int mode : block.modes) {
          const double rounding = path.rounding_at(node, mode);
          if (std::isfinite(rounding)) errors[mode] = std::max(errors[mode], rounding);
        }
      }
      if (block.size() == 1) continue;
      const Vector of_block = block_errors(block, step.length, side.t, s, at_node, tolerance, reference);
      for (std::size_t i = 0; i < block.modes.size(); ++i) {
        double& error = errors[block.modes[i]];
        error = std::max(error, of_block[static_cast<Eigen::Index>(i)]);
      }
    }
  }
  return errors;
}

Vector discrepancies(const RecordedPath& path, const PathPosition& position, const ComplexVector& s,
                     const std::vector<Complex>& exact, const EigenvalueAccuracy& accuracy) {
  const std::vector<bool> alone(static_cast<std::size_t>(s.size()), false);
  const Vector distances = distances_from_spectrum(
      s, alone, with_double_roots(exact, accuracy.tolerance * accuracy.reference), accuracy.reference);
  const Vector promised = accuracy.tolerance * s.cwiseAbs().cwiseMax(accuracy.reference);
  const Vector errors = eigenvalue_errors(path, position, s, accuracy.tolerance, accuracy);
  Vector result = distances;
  for (Eigen::Index mode = 0; mode < s.size(); ++mode) {
    if (std::isfinite(errors[mode])) result[mode] *= promised[mode] / errors[mode];
  }
  return result;
}

}  // namespace eigentrail
