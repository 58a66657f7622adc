#include "accuracy/spectrum_distance.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

std::vector<bool> in_blocks(const PathStep& step, std::size_t n_modes) {
  std::vector<bool> result(n_modes, false);
  for (const DenseBlock& block : step.blocks) {
    for (const int mode : block.modes) result[static_cast<std::size_t>(mode)] = block.size() > 1;
  }
  return result;
}

std::vector<Complex> with_conjugates(const std::vector<Complex>& spectrum) {
  std::vector<Complex> members;
  for (const Complex s : spectrum) {
    members.push_back(s);
    if (s.imag() != 0.0) members.push_back(std::conj(s));
  }
  return members;
}

Vector distances_from_spectrum(const ComplexVector& values, const std::vector<bool>& in_block,
                               const std::vector<Complex>& spectrum, double reference) {
  return distances(values, in_block, spectrum, with_conjugates(spectrum), reference);
}

Vector distances_from_members(const ComplexVector& values, const std::vector<Complex>& spectrum,
                              double reference) {
  const std::vector<Complex> members = with_conjugates(spectrum);
  return distances(values, std::vector<bool>(static_cast<std::size_t>(values.size()), true), members, members,
                   reference);
}

}  // namespace eigentrail
