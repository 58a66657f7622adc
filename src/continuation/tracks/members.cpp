#include "continuation/tracks/members.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {

std::vector<int> sorted_modes(const std::vector<int>& modes) {
  std::vector<int> result;
  for (const int mode : modes) {
    if (mode >= 0 && !contains(result, mode)) result.push_back(mode);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

bool contains(const std::vector<int>& list, int entry) {
  return std::find(list.begin(), list.end(), entry) != list.end();
}

std::vector<int> other_members(Eigen::Index size, const std::vector<int>& members) {
  std::vector<int> others;
  for (int i = 0; i < static_cast<int>(size); ++i) {
    if (!contains(members, i)) others.push_back(i);
  }
  return others;
}

double diameter(const ComplexVector& roots, const std::vector<int>& members) {
  double largest = 0.0;
  for (const int i : members) {
    for (const int j : members) largest = std::max(largest, std::abs(roots[i] - roots[j]));
  }
  return largest;
}

double distance_from_others(const ComplexVector& roots, const std::vector<int>& members) {
  double distance = INFINITY;
  for (const int i : other_members(roots.size(), members)) {
    for (const int j : members) distance = std::min(distance, std::abs(roots[i] - roots[j]));
  }
  return distance;
}

std::vector<Complex> roots_of(const Track& track, const std::vector<int>& members) {
  std::vector<Complex> roots;
  roots.reserve(members.size());
  for (const int i : members) roots.push_back(track.roots[i]);
  return roots;
}

Eigen::Index nearest_root(const ComplexVector& roots, Complex s) {
  Eigen::Index nearest = 0;
  (roots.array() - s).abs().minCoeff(&nearest);
  return nearest;
}

Eigen::Index conjugate_of(const ComplexVector& roots, Eigen::Index member) {
  if (roots[member].imag() == 0.0) return member;  // another one may be as near
  return nearest_root(roots, std::conj(roots[member]));
}

bool is_lower(Complex root, Chart chart) {
  return chart == Chart::finite ? root.imag() < 0.0 : root.imag() > 0.0;
}

ComplexVector roots_in_chart(const Track& track, Chart chart) {
  if (track.pair.chart == chart) return track.roots;
  return track.roots.unaryExpr([](Complex root) { return chart_value(root, Chart::reciprocal); });
}

ComplexVector in_chart(ComplexVector series, const Track& track, Chart chart) {
  if (track.pair.chart == chart) return series;
  return series[0] == 0.0 ? ComplexVector() : reciprocal_series(series);
}

ComplexVector root_series(const Track& track, Complex root, Chart chart) {
  ComplexVector series = root_series(track.functions, root);
  return series.size() > 0 ? in_chart(std::move(series), track, chart) : series;
}

Vector rounding_of_roots(const Track& track, const ComplexVector& functions, const ComplexVector& roots,
                         const RoundingThresholds& thresholds) {
  return root_errors(functions, roots,
                     function_rounding(track.pair.Lambda, thresholds.entries * track.pair.rounding));
}

Vector rounding_of_roots(const Track& track, const RoundingThresholds& thresholds) {
  return eigenvalue_rounding(track.pair, track.roots, thresholds.entries);
}

}  // namespace eigentrail
