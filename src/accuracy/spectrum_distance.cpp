#include "accuracy/spectrum_distance.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/eigenvalue_error.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// Factor of the error of the eigenvalue `own`, an index into all eigenvalues `members`, of a mode in a
/// block.
double weight_in_block(const std::vector<Complex>& members, std::size_t own, double error, double scale) {
  double weight = 1.0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i == own) continue;
    weight *= std::min(1.0, std::max(std::abs(members[i] - members[own]), error) / (0.1 * scale));
  }
  return weight;
}

/// The smaller distance of a value from s and from its conjugate: a pair may be given by either member, and
/// close to the real axis rounding decides by which.
double distance_of_modes(Complex value, Complex s) {
  return std::min(std::abs(value - s), std::abs(value - std::conj(s)));
}

std::size_t index_of(const std::vector<Complex>& members, Complex s) {
  return static_cast<std::size_t>(std::find(members.begin(), members.end(), s) - members.begin());
}

Vector distances(const ComplexVector& values, const std::vector<bool>& in_block,
                 const std::vector<Complex>& targets, const std::vector<Complex>& members, double reference) {
  std::vector<Eigen::Index> present;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i].real())) present.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(std::max(targets.size(), present.size()));
  constexpr double nowhere = 1e30;
  Matrix cost = Matrix::Constant(n, n, nowhere);
  const auto count = static_cast<Eigen::Index>(present.size());
  cost.bottomRows(n - count).setZero();  // additional rows for eigenvalues that are not followed
  for (Eigen::Index i = 0; i < count; ++i) {
    const Complex value = values[present[static_cast<std::size_t>(i)]];
    for (std::size_t j = 0; j < targets.size(); ++j) {
      cost(i, static_cast<Eigen::Index>(j)) =
          distance_of_modes(value, targets[j]) / std::max(std::abs(targets[j]), reference);
    }
  }
  const std::vector<int> assignment = optimal_assignment(cost);
  Vector result = Vector::Zero(values.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const int j = assignment[static_cast<std::size_t>(i)];
    const double distance = cost(i, j);
    const Eigen::Index mode = present[static_cast<std::size_t>(i)];
    result[mode] = distance < nowhere ? distance : INFINITY;
    if (!in_block[static_cast<std::size_t>(mode)] || !std::isfinite(result[mode])) continue;
    const Complex s = targets[static_cast<std::size_t>(j)];
    const double scale = std::max(std::abs(s), reference);
    result[mode] *= weight_in_block(members, index_of(members, s), distance * scale, scale);
  }
  return result;
}

/// Whether each mode is part of a block of several on the step.
std::vector<bool> in_blocks(const PathStep& step, std::size_t n_modes) {
  std::vector<bool> result(n_modes, false);
  for (const DenseBlock& block : step.blocks) {
    for (const int mode : block.modes) result[static_cast<std::size_t>(mode)] = block.size() > 1;
  }
  return result;
}

}  // namespace

std::vector<Complex> with_conjugates(const std::vector<Complex>& spectrum) {
  std::vector<Complex> members;
  for (const Complex s : spectrum) {
    members.push_back(s);
    if (s.imag() != 0.0) members.push_back(std::conj(s));
  }
  return members;
}

Vector distances_from_spectrum(const RecordedPath& path, const PathPosition& position,
                               const std::vector<Complex>& spectrum, double reference) {
  const ComplexVector values = path.eigenvalues_at(position);
  const std::vector<bool> in_block =
      in_blocks(path.steps[position.step], static_cast<std::size_t>(values.size()));
  return distances(values, in_block, spectrum, with_conjugates(spectrum), reference);
}

Vector distances_from_spectrum(const ComplexVector& values, bool both_members,
                               const std::vector<Complex>& spectrum, double reference) {
  const std::vector<Complex> members = with_conjugates(spectrum);
  const std::vector<bool> everywhere(static_cast<std::size_t>(values.size()), true);
  return distances(values, everywhere, both_members ? members : spectrum, members, reference);
}

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
  const std::vector<Complex> targets = with_double_roots(exact, accuracy.tolerance * accuracy.reference);
  const Vector promised = accuracy.tolerance * s.cwiseAbs().cwiseMax(accuracy.reference);
  const Vector errors = eigenvalue_errors(path, position, s, accuracy.tolerance, accuracy);
  Vector result = distances(s, alone, targets, targets, accuracy.reference);
  for (Eigen::Index mode = 0; mode < s.size(); ++mode) {
    if (std::isfinite(errors[mode])) result[mode] *= promised[mode] / errors[mode];
  }
  return result;
}

}  // namespace eigentrail
