#include "hard_cases/rivals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "eigentrail/modes/matching.hpp"
#include "hard_cases/clear_parameters.hpp"
#include "hard_cases/reference_labels.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

/// The eigenvalues of a spectrum with which the labels of the last point go on.
ComplexVector successors(const ComplexVector& last, const std::vector<Complex>& spectrum, Carrier carrier) {
  const ComplexVector next =
      Eigen::Map<const ComplexVector>(spectrum.data(), static_cast<Eigen::Index>(spectrum.size()));
  const Matrix distances = Matrix::NullaryExpr(
      last.size(), next.size(), [&](Eigen::Index i, Eigen::Index j) { return std::abs(last[i] - next[j]); });
  if (carrier == Carrier::assignment) return next(optimal_assignment(distances));
  ComplexVector result(last.size());
  for (Eigen::Index i = 0; i < last.size(); ++i) {
    Eigen::Index nearest = 0;
    distances.row(i).minCoeff(&nearest);
    result[i] = next[nearest];
  }
  return result;
}

/// Distance of a label from a mode, of which it may carry either member.
double distance_from_mode(Complex s, Complex mode) {
  return std::min(std::abs(s - mode), std::abs(s - std::conj(mode)));
}

bool on_another_mode(Complex s, std::size_t own, const std::vector<Complex>& modes) {
  const double from_own = distance_from_mode(s, modes[own]);
  double scale = 0.0;
  for (const Complex mode : modes) scale = std::max(scale, std::abs(mode));
  return std::any_of(modes.begin(), modes.end(), [&](Complex other) {
    const bool apart = distance_from_mode(other, modes[own]) > 1e-7 * scale;
    return apart && distance_from_mode(s, other) < 0.5 * from_own;
  });
}

/// For every mode a label that stands on it, each label once.
std::vector<Eigen::Index> labels_on(const std::vector<Complex>& modes, ComplexVector s) {
  std::vector<Eigen::Index> result;
  for (const Complex mode : modes) {
    Eigen::Index nearest = 0;
    (s.array() - mode).abs().minCoeff(&nearest);
    s[nearest] = INFINITY;
    result.push_back(nearest);
  }
  return result;
}

/// Number of different modes: at a coincidence fewer than beside it.
std::size_t n_distinct(const std::vector<Complex>& modes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    count += std::none_of(modes.begin(), modes.begin() + static_cast<std::ptrdiff_t>(i), [&](Complex other) {
      return distance_from_mode(other, modes[i]) <= 1e-7 * std::abs(modes[i]);
    });
  }
  return count;
}

using ModesAt = std::function<std::vector<Complex>(double)>;

/// Follows the labels that stand on the modes at the first grid point within [low, high] through that
/// stretch; from the second one if modes coincide at the first. Counts those that are on another mode.
int wrong_tracks(const GridLoci& loci, double low, double high, const ModesAt& modes) {
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < loci.p.size(); ++k) {
    if (loci.p[k] >= low && loci.p[k] <= high) points.push_back(k);
  }
  if (points.size() < 2) return 0;
  const bool coincide = n_distinct(modes(loci.p[points[0]])) < n_distinct(modes(loci.p[points[1]]));
  const std::size_t start = coincide ? 1 : 0;
  const auto label_of = labels_on(modes(loci.p[points[start]]), loci.s[points[start]]);
  std::vector<bool> wrong(label_of.size(), false);
  for (std::size_t k = start + 1; k < points.size(); ++k) {
    const std::vector<Complex> reference = modes(loci.p[points[k]]);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      if (on_another_mode(loci.s[points[k]][label_of[i]], i, reference)) wrong[i] = true;
    }
  }
  return static_cast<int>(std::count(wrong.begin(), wrong.end(), true));
}

}  // namespace

GridLoci loci_on_grid(const HardCase& hard_case, int n_points, Carrier carrier) {
  GridLoci loci;
  for (int k = 0; k < n_points; ++k)
    loci.p.push_back(parameter_at(hard_case, static_cast<double>(k) / (n_points - 1)));
  if (carrier == Carrier::assurance) return qz_grid(make_setting(hard_case.scene).problem(), loci.p, {});
  const std::vector<Complex> first = hard_case.spectrum(hard_case.from)[0];
  ComplexVector last = Eigen::Map<const ComplexVector>(first.data(), static_cast<Eigen::Index>(first.size()));
  for (const double p : loci.p) {
    last = successors(last, hard_case.spectrum(p)[0], carrier);
    loci.s.push_back(last);
  }
  loci.completed = true;
  return loci;
}

int count_wrong_tracks(const HardCase& hard_case, const GridLoci& loci) {
  if (hard_case.has_branches) {
    const auto [low, high] = std::minmax(hard_case.from, hard_case.to);
    return wrong_tracks(loci, low, high, [&](double p) {
      std::vector<Complex> modes;
      for (const auto& branch : hard_case.branches) modes.push_back(branch(p));
      return modes;
    });
  }
  int count = 0;
  for (const LabelledStretch& stretch : reference_labels(hard_case)) {
    // Loci on a grid of the parameter stay on the branch they started on.
    if (stretch.branch() == 0) count += wrong_tracks(loci, stretch.low(), stretch.high(), stretch);
  }
  return count;
}

}  // namespace eigentrail::test
