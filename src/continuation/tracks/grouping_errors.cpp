#include "continuation/tracks/grouping_errors.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Whether all eigenvalues of a block are one.
bool coincide(const Track& track) {
  constexpr double known = 1e-7;  // relative: about the root of rounding, to which a double one is known
  return track.size() > 1 && (track.roots.array() - track.roots.mean()).abs().maxCoeff() <=
                                 known * track.roots.cwiseAbs().maxCoeff();
}

/// Series of every eigenvalue of a track in a chart; of one that is multiple, as in equal parts, only one.
/// Empty if one of them is not simple, or infinite in that chart.
std::vector<ComplexVector> eigenvalue_series(const Track& track, Chart chart) {
  std::vector<ComplexVector> all;
  if (coincide(track)) {
    const ComplexVector mean = in_chart(mean_series(track.series.Lambda), track, chart);
    if (mean.size() == 0) return {};
    return {mean};
  }
  for (const Complex root : track.roots) {
    all.push_back(root_series(track, root, chart));
    if (all.back().size() == 0) return {};
  }
  return all;
}

/// Smooth functions of the eigenvalues as a block, from their single series: the mean, and the means of the
/// powers 2 to k of the differences from it.
ComplexMatrix symmetric_functions(const std::vector<ComplexVector>& series) {
  const auto k = static_cast<Eigen::Index>(series.size());
  ComplexVector mean = ComplexVector::Zero(series.front().size());
  for (const ComplexVector& s : series) mean += s / static_cast<double>(k);
  ComplexMatrix functions(k, mean.size());
  functions.row(0) = mean.transpose();
  std::vector<ComplexVector> powers(series.size(), ComplexVector::Unit(mean.size(), 0));
  for (Eigen::Index j = 1; j <= k; ++j) {
    ComplexVector sum = ComplexVector::Zero(mean.size());
    for (std::size_t i = 0; i < series.size(); ++i) {
      powers[i] = multiply_series(powers[i], series[i] - mean);
      sum += powers[i] / static_cast<double>(k);
    }
    if (j >= 2) functions.row(j - 1) = sum.transpose();
  }
  return functions;
}

/// Largest error of an eigenvalue caused by errors of the symmetric functions: the change of the
/// characteristic polynomial divided by its slope at the root, the product of the distances from the other
/// roots. Distances count as at least `least_gap`.
double symmetric_root_error(const ComplexVector& roots, const Vector& errors, double least_gap) {
  const Eigen::Index k = roots.size();
  const Complex mean = roots.mean();
  double worst = 0.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    double slope = 1.0;
    for (Eigen::Index j = 0; j < k; ++j) {
      if (j != i) slope *= std::max(std::abs(roots[i] - roots[j]), least_gap);
    }
    double change = 0.0;
    for (Eigen::Index j = 2; j <= k; ++j) {
      const double power =
          std::pow(std::max(std::abs(roots[i] - mean), least_gap), static_cast<double>(k - j));
      change += static_cast<double>(k) / static_cast<double>(j) * errors[j - 1] * power;
    }
    worst = std::max(worst, change / slope);
  }
  return errors[0] + worst;
}

}  // namespace

Eigen::Index distinct_eigenvalues(const Track& track) {
  return coincide(track) ? 1 : track.size();
}

double error_as_block(const PathNode& left, const PathNode& right, std::size_t index,
                      const std::vector<Partner>& partners, double h, double least_gap) {
  const Chart chart = right.tracks[index].pair.chart;
  const auto members = [&](const PathNode& node) {
    std::vector<ComplexVector> all = eigenvalue_series(node.tracks[index], chart);
    for (const Partner& partner : partners) {
      std::vector<ComplexVector> more = eigenvalue_series(node.tracks[partner.track], chart);
      for (ComplexVector& series : more)
        all.push_back(partner.conjugate ? ComplexVector(series.conjugate()) : series);
      if (more.empty()) return std::vector<ComplexVector>{};
    }
    return all;
  };
  const std::vector<ComplexVector> at_left = members(left);
  const std::vector<ComplexVector> at_right = members(right);
  if (at_left.empty() || at_left.size() != at_right.size()) return INFINITY;
  const ComplexMatrix from = symmetric_functions(at_left);
  const ComplexMatrix to = symmetric_functions(at_right);
  const Vector errors = HermiteInterpolant(h, from, to).error_without_last();
  double worst = 0.0;
  for (const auto* end : {&at_left, &at_right}) {
    ComplexVector roots(static_cast<Eigen::Index>(end->size()));
    for (std::size_t i = 0; i < end->size(); ++i) roots[static_cast<Eigen::Index>(i)] = (*end)[i][0];
    worst = std::max(worst, symmetric_root_error(roots, errors, least_gap));
  }
  return std::isfinite(worst) ? worst : INFINITY;
}

namespace {

/// Estimated error of an eigenvalue from its series at both ends of a step, relative to max(|mu|, reference).
double relative_error(const ComplexVector& from, const ComplexVector& to, double h, double reference) {
  const double scale = std::max(std::min(std::abs(from[0]), std::abs(to[0])), reference);
  return HermiteInterpolant(h, from.transpose(), to.transpose()).error_without_last()[0] / scale;
}

/// The same for 1/mu; infinite where mu vanishes.
double relative_error_of_reciprocal(const ComplexVector& from, const ComplexVector& to, double h,
                                    double reference) {
  if (from[0] == 0.0 || to[0] == 0.0) return INFINITY;
  return relative_error(reciprocal_series(from), reciprocal_series(to), h, reference);
}

}  // namespace

double error_in_other_chart(const PathProblem& problem, const PathNode& left, const PathNode& right,
                            std::size_t index, double h) {
  const Track& a = left.tracks[index];
  const Track& b = right.tracks[index];
  if (a.size() != 1 || b.size() != 1) return INFINITY;
  return relative_error_of_reciprocal(a.functions.row(0).transpose(), b.functions.row(0).transpose(), h,
                                      problem.reference(other(b.pair.chart)));
}

Vector errors_as_singles(const PathProblem& problem, const PathNode& left, const PathNode& right,
                         std::size_t index, double h) {
  const Track& a = left.tracks[index];
  const Track& b = right.tracks[index];
  const Chart chart = b.pair.chart;
  Vector errors = Vector::Constant(b.size(), INFINITY);
  if (a.size() != b.size()) return errors;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const ComplexVector from = root_series(a.functions, a.roots[i]);
    const ComplexVector to = root_series(b.functions, b.roots[i]);
    if (from.size() == 0 || to.size() == 0) continue;
    // fmin ignores NaN.
    errors[i] = std::fmin(errors[i], relative_error(from, to, h, problem.reference(chart)));
    errors[i] =
        std::fmin(errors[i], relative_error_of_reciprocal(from, to, h, problem.reference(other(chart))));
  }
  return errors;
}

}  // namespace eigentrail
