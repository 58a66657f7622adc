#include "continuation/events/meetings.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// The eigenvalues with these indices as a block of their own; empty when it cannot be told from the others.
std::vector<ComplexMatrix> part_of_track(const Track& track, const std::vector<int>& members) {
  return part_series(track.series.Lambda, roots_of(track, members));
}

std::vector<int> both(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> members;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(members));
  return members;
}

/// The eigenvalues that lie about as close to the two as these to each other, or this share of their size.
std::vector<int> with_bystanders(const ComplexVector& roots, std::vector<int> members,
                                 double one_point = 1e-10) {
  constexpr double as_close = 3.0;
  double inside = one_point * roots.cwiseAbs().maxCoeff();
  for (const int i : members) {
    for (const int j : members) inside = std::max(inside, std::abs(roots[i] - roots[j]));
  }
  std::vector<int> all = members;
  for (int k = 0; k < static_cast<int>(roots.size()); ++k) {
    if (std::find(members.begin(), members.end(), k) != members.end()) continue;
    const bool close = std::any_of(members.begin(), members.end(),
                                   [&](int i) { return std::abs(roots[i] - roots[k]) <= as_close * inside; });
    if (close) all.push_back(k);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Value, slope and second derivative of a polynomial.
std::array<Complex, 3> jet(const ComplexVector& series, Complex at) {
  std::array<Complex, 3> result{};
  for (Eigen::Index j = series.size() - 1; j >= 0; --j) {
    result[2] = result[2] * at + 2.0 * result[1];
    result[1] = result[1] * at + result[0];
    result[0] = result[0] * at + series[j];
  }
  return result;
}

/// Two roots much closer to each other than to zero: as the parabola about the point between them has them.
void improve_double_root(const ComplexVector& series, std::array<Complex, 2>& roots) {
  constexpr double close = 0.1;
  Complex middle = 0.5 * (roots[0] + roots[1]);
  if (!(std::abs(roots[0] - roots[1]) <= close * std::abs(middle))) return;
  for (int k = 0; k < 3; ++k) {
    const auto [value, slope, curvature] = jet(series, middle);
    if (curvature == 0.0) return;
    middle -= slope / curvature;
  }
  const auto [value, slope, curvature] = jet(series, middle);
  const Complex half = std::sqrt(-2.0 * value / curvature);
  roots = {middle - half, middle + half};
  if (std::abs(roots[1]) < std::abs(roots[0])) std::swap(roots[0], roots[1]);
}

/// Roots of a series by magnitude. A companion matrix tells small roots to rounding of the large ones only;
/// those near the point come from the first three coefficients, improved by Newton's method with all of them.
std::vector<Complex> roots_by_magnitude(const ComplexVector& series, double reach) {
  std::vector<Complex> roots = polynomial_roots(series);
  std::sort(roots.begin(), roots.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  const Complex root_of_discriminant = std::sqrt(series[1] * series[1] - 4.0 * series[0] * series[2]);
  const Complex same_sign = (std::conj(series[1]) * root_of_discriminant).real() >= 0.0
                                ? root_of_discriminant
                                : -root_of_discriminant;
  const Complex sum = series[1] + same_sign;
  std::array<Complex, 2> near{0.0, 0.0};
  if (sum != 0.0) near = {-2.0 * series[0] / sum, -0.5 * sum / series[2]};
  improve_double_root(series, near);
  for (std::size_t i = 0; i < std::min<std::size_t>(2, roots.size()); ++i) {
    if (!(std::abs(near[i]) < 0.03 * std::abs(reach))) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [value, slope, curvature] = jet(series, near[i]);
      // Double roots are as the parabola has them.
      if (std::abs(slope) > 1e-6 * std::abs(series[1]) + 1e-12 * std::abs(series[2] * reach))
        near[i] -= value / slope;
    }
    roots[i] = near[i];
  }
  return roots;
}

/// Kind and place of a meeting, from the roots of the discriminant nearest to the point. A root is an
/// exceptional point; on the real axis it is a collision, beside it a veering. A double root on the axis is a
/// crossing, or a collision where the block is defective.
void classify(const std::vector<Complex>& roots, double reach, double resolution, double noise,
              bool defective, const MeetingThresholds& thresholds, Meeting& meeting) {
  const Complex first = roots[0];
  const bool has_second =
      roots.size() > 1 && std::abs(roots[1]) <= 1e3 * std::max(std::abs(first), resolution);
  const Complex second = has_second ? roots[1] : first;
  const double separation = 0.5 * std::abs(first - second);
  // The slope of the discriminant, which `noise` is divided by, vanishes halfway between two roots.
  const double on_axis = has_second ? resolution : std::max(noise, thresholds.on_axis * reach);
  meeting.offset = first.real();
  if (has_second && separation <= 10.0 * resolution) {
    // A double root at a complex parameter: the eigenvalues pass each other on the real axis.
    meeting.found = std::abs((first + second).imag()) <= 20.0 * std::max(resolution, noise);
    meeting.kind = defective ? EventKind::collision : EventKind::crossing;
    meeting.offset = 0.5 * (first + second).real();
  } else if (std::abs(first.imag()) <= on_axis) {
    meeting.kind = EventKind::collision;
  } else {
    meeting.kind = EventKind::veering;
    // Mirror images are one point, seen from both sides of the axis; others are two points, of which the
    // first is nearer.
    const bool around =
        has_second && std::abs(first - std::conj(second)) <= thresholds.beside_axis * separation;
    if (around) meeting.offset = 0.5 * (first + second).real();
    meeting.half_width =
        around ? 0.5 * (std::abs(first.imag()) + std::abs(second.imag())) : std::abs(first.imag());
  }
}

/// Two eigenvalues whose distance stays within `resolution` are one, which meets nobody.
bool vanishes(const ComplexVector& gap, double reach, double resolution) {
  double size = 0.0;
  for (Eigen::Index k = gap.size() - 1; k >= 0; --k) size = size * std::abs(reach) + std::abs(gap[k]);
  return std::sqrt(size) <= resolution;
}

ComplexMatrix centred(const std::vector<ComplexMatrix>& Lambda, double h) {
  ComplexMatrix N = evaluate_series(Lambda, h);
  N.diagonal().array() -= N.trace() / static_cast<double>(N.rows());
  return N;
}

/// What rounding leaves of a part of a block: of its Lambda, and of its slope.
struct Rounding {
  double lambda = 0.0;
  double slope = 0.0;
};

/// Lambda is known to rounding times the condition of the block, which is normwise and overrates graded
/// pencils.
Rounding rounding_of(const Track& track, const std::vector<ComplexMatrix>& part) {
  constexpr double worst_condition = 100.0;
  const double condition = std::clamp(track.pair.condition, 1.0, worst_condition);
  return {4e-15 * track.pair.Lambda.norm() * condition, part.size() > 1 ? part[1].norm() : 1.0};
}

/// Distance of members of a block from its other eigenvalues.
double distance_from_others(const ComplexVector& roots, const std::vector<int>& members) {
  double distance = INFINITY;
  for (int i = 0; i < static_cast<int>(roots.size()); ++i) {
    if (std::find(members.begin(), members.end(), i) != members.end()) continue;
    for (const int j : members) distance = std::min(distance, std::abs(roots[i] - roots[j]));
  }
  return distance;
}

/// How well members of a block are told apart on a step of length `reach`: the nearer the others are, the
/// less is known of the members' slopes.
double member_resolution(const Track& track, const std::vector<int>& members, double reach) {
  constexpr double coinciding = 1e-12;
  const Rounding rounding = rounding_of(track, track.series.Lambda);
  const double of_slope =
      10.0 * rounding.lambda * rounding.slope * std::abs(reach) / distance_from_others(track.roots, members);
  return std::max(coinciding * track.pair.Lambda.norm(), of_slope);
}

/// All eigenvalues of a part in one point: their distances from the mean vanish together, linearly.
std::optional<Meeting> common_crossing(const std::vector<ComplexMatrix>& part, const Rounding& rounding,
                                       double reach) {
  constexpr double remainder = 1e-3;
  const ComplexMatrix here = centred(part, 0.0);
  const ComplexMatrix slope = (centred(part, 1e-3 * reach) - centred(part, -1e-3 * reach)) / (2e-3 * reach);
  const double size = slope.squaredNorm();
  if (!(size > 0.0)) return std::nullopt;
  const double offset = -slope.cwiseProduct(here.conjugate()).sum().real() / size;
  const double left = centred(part, offset).norm();
  if (!(left <= remainder * here.norm() || left <= 10.0 * rounding.lambda)) return std::nullopt;
  Meeting meeting;
  meeting.found = true;
  meeting.kind = EventKind::crossing;
  meeting.offset = offset;
  return meeting;
}

/// All eigenvalues of a part in one exceptional point: the product of their distances from the mean has a
/// simple root there, while each of them varies like the m-th root of the distance.
std::optional<Meeting> common_collision(const std::vector<ComplexMatrix>& part, double reach) {
  const auto product = [&](double h) { return centred(part, h).determinant(); };
  const auto radius = [&](double h) {
    return Eigen::ComplexEigenSolver<ComplexMatrix>(centred(part, h), false)
        .eigenvalues()
        .cwiseAbs()
        .maxCoeff();
  };
  const double width = 1e-3 * std::abs(reach);
  const Complex slope = (product(width) - product(-width)) / (2.0 * width);
  if (slope == 0.0) return std::nullopt;
  const Complex root = -product(0.0) / slope;
  const bool near = std::abs(root.imag()) <= 1e-3 * std::abs(reach) && std::abs(root) <= std::abs(reach);
  if (!near || !(radius(root.real()) < 0.5 * radius(root.real() + width))) return std::nullopt;
  Meeting meeting;
  meeting.found = true;
  meeting.kind = EventKind::collision;
  meeting.offset = root.real();
  const auto m = static_cast<double>(part[0].rows());
  meeting.puiseux = std::pow((part[0].rows() % 2 == 0 ? -1.0 : 1.0) * slope, 1.0 / m);
  return meeting;
}

/// Where all of a cluster meet, if it has more eigenvalues than these members.
std::optional<Meeting> meeting_in_one_point(const Track& track, const std::vector<int>& members,
                                            const std::vector<int>& cluster, double reach) {
  if (cluster.size() == members.size()) return std::nullopt;
  const std::vector<ComplexMatrix> part = part_of_track(track, cluster);
  if (part.empty()) return std::nullopt;
  auto meeting = common_crossing(part, rounding_of(track, part), reach);
  if (!meeting) meeting = common_collision(part, reach);
  if (meeting) meeting->members = cluster;
  return meeting;
}

}  // namespace

ComplexVector discriminant_of(const Track& track, const std::vector<int>& a, const std::vector<int>& b) {
  const std::vector<int> members = both(a, b);
  if (with_bystanders(track.roots, members).size() == members.size()) {
    const std::vector<ComplexMatrix> part = part_of_track(track, members);
    if (!part.empty()) return discriminant_series(part, static_cast<Eigen::Index>(a.size()));
  }
  // Apart from each other, they are told one by one.
  const std::vector<ComplexMatrix> first = part_of_track(track, a);
  const std::vector<ComplexMatrix> second = part_of_track(track, b);
  if (first.empty() || second.empty()) return {};
  return discriminant_series(mean_series(first), mean_series(second));
}

Meeting nearest_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b,
                        double reach, const MeetingThresholds& thresholds) {
  const std::vector<int> members = both(a, b);
  if (auto meeting = meeting_in_one_point(track, members, with_bystanders(track.roots, members), reach))
    return *meeting;
  Meeting meeting;
  const ComplexVector gap = discriminant_of(track, a, b);
  if (gap.size() == 0) return meeting;
  if (vanishes(gap, reach, member_resolution(track, members, reach))) {
    // The two are one, and meet others together.
    constexpr double nearby = 1e-7;
    const std::vector<int> others = with_bystanders(track.roots, members, nearby);
    return meeting_in_one_point(track, members, others, reach).value_or(meeting);
  }
  const std::vector<Complex> roots = roots_by_magnitude(gap, reach);
  if (roots.empty() || std::abs(roots[0]) > 2.0 * std::abs(reach)) return meeting;
  meeting.found = true;
  meeting.members = members;
  meeting.puiseux = std::sqrt(gap[1]);
  const std::vector<ComplexMatrix> part = part_of_track(track, members);
  const std::vector<ComplexMatrix>& Lambda = part.empty() ? track.series.Lambda : part;
  const Rounding rounding = rounding_of(track, Lambda);
  const double distance = centred(Lambda, 0.0).norm();
  // The coordinate itself is rounded, too: what counts where the eigenvalues that meet are zero.
  constexpr double coordinate_rounding = 1e-14;
  double resolution = coordinate_rounding * std::abs(reach);
  const double noise = std::abs(gap[1]) > 0.0
                           ? 10.0 * rounding.lambda * std::max(distance, rounding.lambda) / std::abs(gap[1])
                           : 0.0;
  // The gap of a defective part is known to rounding times its size: double roots to the root of that, single
  // ones, whose parabola has no other root within reach, to its share in their slope.
  const double curvature = std::abs(gap[2]);
  const bool is_single = std::abs(gap[1]) > 2.0 * std::abs(reach) * curvature;
  const bool defective =
      distance > 1e-6 * std::max(track.pair.Lambda.norm(), 1e-3 * rounding.slope * std::abs(reach));
  if (defective && is_single) {
    resolution = std::max(resolution, 4.0 * rounding.lambda * distance / std::abs(gap[1]));
  } else if (defective && curvature > 0.0) {
    resolution = std::max(resolution, std::sqrt(4.0 * rounding.lambda * distance / curvature));
  } else if (rounding.slope > 0.0) {
    resolution = std::max(resolution, rounding.lambda / rounding.slope);
  }
  classify(roots, std::abs(reach), resolution, noise, defective, thresholds, meeting);
  return meeting;
}

double earlier_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b, double h) {
  constexpr double nearby = 0.2;  // of the step: as far as the series tells
  constexpr double apart = 1e-6;  // of the step: nearer ones are this one
  constexpr double on_axis = 1e-2;
  const ComplexVector gap = discriminant_of(track, a, b);
  double offset = 0.0;
  if (gap.size() == 0) return offset;
  for (const Complex root : polynomial_roots(gap)) {
    const bool is_earlier = root.real() * h < 0.0 && std::abs(root.imag()) <= on_axis * std::abs(root.real());
    const double distance = std::abs(root.real());
    if (is_earlier && distance > std::max(std::abs(offset), apart * std::abs(h)) &&
        distance < nearby * std::abs(h))
      offset = root.real();
  }
  return offset;
}

}  // namespace eigentrail
