#include "continuation/tracks/partner.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Distance of a complex number from the real segment between 0 and h.
double distance_to_step(Complex z, double h) {
  const double along = h > 0.0 ? std::clamp(z.real(), 0.0, h) : std::clamp(z.real(), h, 0.0);
  return std::abs(z - along);
}

/// A series is not accurate where its last term is a larger share of the largest term: its terms do not
/// decrease there.
constexpr double last_term = 0.3;

/// Whether the last term of a series at z is small enough.
bool converges_at(const ComplexVector& series, Complex z) {
  double largest = 0.0;
  double term = 0.0;
  double power = 1.0;
  for (const Complex coefficient : series) {
    term = std::abs(coefficient) * power;
    largest = std::max(largest, term);
    power *= std::abs(z);
  }
  return term <= last_term * largest;
}

}  // namespace

double meeting_distance(const ComplexVector& a, const ComplexVector& b, double spread, double h, double limit,
                        Doubtful doubtful) {
  ComplexVector delta = discriminant_series(a, b);
  if (spread > 0.0 && spread >= std::abs(delta[0])) return INFINITY;
  if (spread > 0.0) delta[0] -= spread * delta[0] / std::abs(delta[0]);
  if (has_no_root_within(delta, std::abs(h) + limit)) return INFINITY;
  double nearest = INFINITY;
  for (const Complex root : polynomial_roots(delta)) {
    if (doubtful == Doubtful::counts || converges_at(delta, root))
      nearest = std::min(nearest, distance_to_step(root, h));
  }
  return nearest;
}

namespace {

/// An eigenvalue as a series, or the mean of several.
struct Representative {
  ComplexVector series;
  double spread = 0.0;  ///< square of the largest distance of an eigenvalue from the mean
};

/// The eigenvalues of a track in a chart, as far as they are simple and finite there, and the mean of a
/// block: series of members that are close to each other are known less well, or not at all.
std::vector<Representative> representatives(const Track& track, Chart chart) {
  std::vector<Representative> all;
  for (const Complex root : track.roots) {
    ComplexVector own = root_series(track, root, chart);
    if (own.size() > 0) all.push_back({std::move(own)});
  }
  if (track.size() == 1) return all;
  Representative mean{in_chart(mean_series(track.series.Lambda), track, chart)};
  if (mean.series.size() == 0) return all;
  for (const Complex root : track.roots) {
    const Complex here = track.pair.chart == chart ? root : 1.0 / root;
    mean.spread = std::max(mean.spread, std::norm(here - mean.series[0]));
  }
  all.push_back(std::move(mean));
  return all;
}

/// Distance from the step of the nearest meeting of two of them, of one track each.
double meeting_distance(const std::vector<Representative>& some, const std::vector<Representative>& others,
                        double h, double limit) {
  double nearest = INFINITY;
  for (const Representative& a : some) {
    for (const Representative& b : others)
      nearest = std::min(nearest, meeting_distance(a.series, b.series, std::max(a.spread, b.spread), h, limit,
                                                   Doubtful::is_left_out));
  }
  return nearest;
}

/// Whether the conjugates of a track's eigenvalues belong to its own equations. Those of a complex part
/// belong to its conjugate part, and are not met.
bool meets_conjugates(const PathNode& node, const Track& track) {
  return !track.pair.is_real && node.pencil.of(track.pair.part).complex_sign == 0;
}

std::vector<Representative> conjugates(std::vector<Representative> all) {
  for (Representative& one : all) one.series = one.series.conjugate().eval();
  return all;
}

}  // namespace

std::vector<Partner> find_partners(const PathNode& node, std::size_t index, double h, double reach) {
  const Track& track = node.tracks[index];
  const double limit = reach * std::abs(h);
  const std::vector<Representative> own = representatives(track, track.pair.chart);
  std::vector<Partner> partners;
  // A complex mode can also meet its own conjugate, or that of another track, close to the real axis. Then
  // the track is joined with its own conjugate.
  double nearest_conjugate = INFINITY;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    const Track& other = node.tracks[i];
    if (other.pair.part != track.pair.part) continue;  // they cross and never meet
    const std::vector<Representative> others = i == index ? own : representatives(other, track.pair.chart);
    const double distance = i == index ? INFINITY : meeting_distance(own, others, h, limit);
    if (distance <= limit) partners.push_back({false, i, distance});
    if (!meets_conjugates(node, track) || other.pair.is_real) continue;
    nearest_conjugate = std::min(nearest_conjugate, meeting_distance(own, conjugates(others), h, limit));
  }
  if (nearest_conjugate <= limit) partners.push_back({true, index, nearest_conjugate});
  std::sort(partners.begin(), partners.end(),
            [](const Partner& a, const Partner& b) { return a.distance < b.distance; });
  return partners;
}

namespace {

/// Eigenvalues that meet have one singularity, and last terms of their series of one size (Darboux). With
/// less than this share of that of another one, an eigenvalue is not what keeps that from converging.
constexpr double same_singularity = 0.1;

/// Largest last term of the series of the eigenvalues of a track in a chart; infinite where one has none.
double last_term_of(const Track& track, Chart chart) {
  double largest = 0.0;
  for (const Complex root : track.roots) {
    const ComplexVector series = root_series(track, root, chart);
    if (series.size() == 0) return INFINITY;
    largest = std::max(largest, std::abs(series[series.size() - 1]));
  }
  return largest;
}

}  // namespace

bool may_limit(const PathNode& node, std::size_t index, const Partner& partner) {
  const Chart chart = node.tracks[index].pair.chart;
  const double own = last_term_of(node.tracks[index], chart);
  const double other = last_term_of(node.tracks[partner.track], chart);
  return other >= same_singularity * own || !std::isfinite(own);
}

std::vector<Partner> limiting_partners(const PathNode& node, std::size_t index, double h, double reach) {
  std::vector<Partner> partners = find_partners(node, index, h, reach);
  std::erase_if(partners, [&](const Partner& one) { return !may_limit(node, index, one); });
  return partners;
}

namespace {

/// Smallest distance of an eigenvalue of one track from one of another.
double gap_between(const ComplexVector& a, const ComplexVector& b) {
  double gap = INFINITY;
  for (const Complex s : a) gap = std::min(gap, (b.array() - s).abs().minCoeff());
  return gap;
}

}  // namespace

std::optional<Partner> nearest_partner(const PathNode& node, std::size_t index) {
  const Track& track = node.tracks[index];
  Partner nearest{false, index, INFINITY};
  if (meets_conjugates(node, track))
    nearest = {true, index, gap_between(track.roots, track.roots.conjugate())};
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    const Track& other = node.tracks[i];
    if (i == index || other.pair.part != track.pair.part) continue;
    const double gap = gap_between(track.roots, roots_in_chart(other, track.pair.chart));
    if (gap < nearest.distance) nearest = {false, i, gap};
  }
  if (!std::isfinite(nearest.distance)) return std::nullopt;
  return nearest;
}

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
