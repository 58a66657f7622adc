#include "continuation/events/meetings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/events/common_collision.hpp"
#include "continuation/events/meeting_resolution.hpp"
#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Newton corrections of roots whose first approximation has a few digits: three reach rounding.
constexpr int root_corrections = 3;
/// Safety factor on estimates of rounding errors.
constexpr double rounding_margin = 10.0;
/// As a share of the reach: step of central differences of Lambda and of functions of it. Their truncation
/// error, about the square, is below `remainder`.
constexpr double difference_step = 1e-3;

/// Series of the part of Lambda with these eigenvalues; empty when it cannot be separated from the others.
std::vector<ComplexMatrix> part_of_track(const Track& track, const std::vector<int>& members) {
  return part_series(track.series.Lambda, roots_of(track, members));
}

/// `members` and the eigenvalues that are not much farther from one of them than these are from each other.
/// Distances up to the share `one_point` of the largest eigenvalue count as none.
std::vector<int> with_bystanders(const ComplexVector& roots, std::vector<int> members,
                                 double one_point = 1e-10) {
  constexpr double as_close = 3.0;  // times the largest distance among the members
  const double inside = std::max(one_point * roots.cwiseAbs().maxCoeff(), diameter(roots, members));
  std::vector<int> all = members;
  for (const int k : other_members(roots.size(), members)) {
    const bool close = std::any_of(members.begin(), members.end(),
                                   [&](int i) { return std::abs(roots[i] - roots[k]) <= as_close * inside; });
    if (close) all.push_back(k);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Replaces two roots that are much closer to each other than to zero by the roots of the parabola about the
/// place between them where the slope vanishes. Close to a double root this keeps more digits than Newton's
/// method for each root.
void improve_double_root(const ComplexVector& series, std::array<Complex, 2>& roots) {
  constexpr double close = 0.1;  // their distance as a share of the distance from zero
  Complex middle = 0.5 * (roots[0] + roots[1]);
  if (!(std::abs(roots[0] - roots[1]) <= close * std::abs(middle))) return;
  for (int k = 0; k < root_corrections; ++k) {
    const auto [value, slope, curvature] = jet(series, middle);
    if (curvature == 0.0) return;
    middle -= slope / curvature;
  }
  const auto [value, slope, curvature] = jet(series, middle);
  const Complex half = std::sqrt(-2.0 * value / curvature);
  roots = {middle - half, middle + half};
  if (std::abs(roots[1]) < std::abs(roots[0])) std::swap(roots[0], roots[1]);
}

/// Roots of a series by ascending magnitude. The companion matrix gives small roots with an absolute error of
/// the rounding of large ones. The two nearest to zero therefore come from the first three coefficients and
/// Newton's method with all of them.
std::vector<Complex> roots_by_magnitude(const ComplexVector& series, double reach) {
  // As a share of the reach: only for roots nearer than this do three coefficients give a few digits.
  constexpr double close = 0.03;
  // A slope at the root up to these shares of the slope at zero, and of the curvature times the reach, is
  // that of a double root. There Newton's method loses digits, and improve_double_root has done the work.
  constexpr double flat_for_slope = 1e-6;
  constexpr double flat_for_curvature = 1e-12;
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
    if (!(std::abs(near[i]) < close * std::abs(reach))) continue;
    for (int k = 0; k < root_corrections; ++k) {
      const auto [value, slope, curvature] = jet(series, near[i]);
      if (std::abs(slope) >
          flat_for_slope * std::abs(series[1]) + flat_for_curvature * std::abs(series[2] * reach))
        near[i] -= value / slope;
    }
    roots[i] = near[i];
  }
  return roots;
}

/// Sets kind, offset and half-width of a meeting from the roots of the discriminant nearest to the point. A
/// root is an exceptional point: a collision on the real axis, a veering beside it. A double root on the axis
/// is a crossing, or a collision where the block is defective.
void classify(const std::vector<Complex>& roots, double reach, const RootResolution& known,
              const MeetingThresholds& thresholds, Meeting& meeting) {
  // A second root so many times farther away than the first one belongs to another meeting.
  constexpr double much_farther = 1e3;
  // In units of the resolution: half the distance of two roots that form a double root, where the part is
  // defective, and the sum of their imaginary parts up to which it lies on the axis. The second is twice the
  // first, since it adds two parts.
  constexpr double of_double_root = 10.0;
  constexpr double sum_on_axis = 20.0;
  // In units of the resolution, which is a bound: rounding seldom leaves more of a crossing. Of two roots
  // that are farther apart it is not certain that they are one.
  constexpr double left_of_a_crossing = 0.1;
  const Complex first = roots[0];
  const bool has_second =
      roots.size() > 1 && std::abs(roots[1]) <= much_farther * std::max(std::abs(first), known.roots);
  const Complex second = has_second ? roots[1] : first;
  const double separation = 0.5 * std::abs(first - second);
  // The slope of the discriminant, by which `noise` is divided, vanishes halfway between two roots.
  const double on_axis = has_second ? known.roots : std::max(known.noise, thresholds.on_axis * reach);
  meeting.offset = first.real();
  const bool two_collisions = known.bounded && separation > known.roots &&
                              std::abs(first.imag()) <= known.roots && std::abs(second.imag()) <= known.roots;
  if (has_second && separation <= (known.defective ? of_double_root : 1.0) * known.roots && !two_collisions) {
    // At a crossing at a complex parameter nothing happens on the real axis.
    meeting.found = std::abs((first + second).imag()) <= sum_on_axis * std::max(known.roots, known.noise);
    meeting.kind = known.defective ? EventKind::collision : EventKind::crossing;
    meeting.is_certain = known.defective || separation <= left_of_a_crossing * known.roots;
    meeting.offset = 0.5 * (first + second).real();
    meeting.puiseux = 0.0;  // they pass through each other
  } else if (std::abs(first.imag()) <= on_axis) {
    meeting.kind = EventKind::collision;
  } else {
    meeting.kind = EventKind::veering;
    // A conjugate pair of roots is one veering. Otherwise there are two, and the nearer one is returned.
    const bool around =
        has_second && std::abs(first - std::conj(second)) <= thresholds.beside_axis * separation;
    if (around) meeting.offset = 0.5 * (first + second).real();
    meeting.half_width =
        around ? 0.5 * (std::abs(first.imag()) + std::abs(second.imag())) : std::abs(first.imag());
  }
}

/// Whether two eigenvalues coincide everywhere: a bound of their half distance within reach, from the
/// coefficients of the discriminant, is at most `resolution`.
bool vanishes(const ComplexVector& discriminant, double reach, double resolution) {
  double size = 0.0;
  for (Eigen::Index k = discriminant.size() - 1; k >= 0; --k)
    size = size * std::abs(reach) + std::abs(discriminant[k]);
  return std::sqrt(size) <= resolution;
}

/// Distance within which members of a block cannot be distinguished on a step of length `reach`: at least a
/// share of the block's norm, and more where other eigenvalues are close and make the slopes of the members
/// inaccurate.
double member_resolution(const Track& track, const std::vector<int>& members, double reach) {
  constexpr double coinciding = 1e-12;  // of the norm of the block, for rounding
  const PartRounding rounding = rounding_of(track, track.series.Lambda);
  const double of_slope = rounding_margin * rounding.lambda * rounding.slope * std::abs(reach) /
                          distance_from_others(track.roots, members);
  return std::max(coinciding * track.pair.Lambda.norm(), of_slope);
}

/// The crossing of all eigenvalues of a part in one point, where the part of Lambda is a multiple of the unit
/// matrix. The centred part is approximated by a linear function; its zero is found by least squares. Empty
/// if the centred part does not vanish there.
std::optional<Meeting> common_crossing(const std::vector<ComplexMatrix>& part, const PartRounding& rounding,
                                       double reach) {
  constexpr double remainder = 1e-3;  // of its norm at the point: what may be left at the zero
  const ComplexMatrix here = centred(part, 0.0);
  const ComplexMatrix slope =
      (centred(part, difference_step * reach) - centred(part, -difference_step * reach)) /
      (2.0 * difference_step * reach);
  const double size = slope.squaredNorm();
  if (!(size > 0.0)) return std::nullopt;
  const double offset = -slope.cwiseProduct(here.conjugate()).sum().real() / size;
  const double left = centred(part, offset).norm();
  if (!(left <= remainder * here.norm() || left <= rounding_margin * rounding.lambda)) return std::nullopt;
  return Meeting{.found = true, .kind = EventKind::crossing, .offset = offset};
}

/// The meeting of all eigenvalues of a cluster in one point; empty if there is none, or if the cluster has no
/// more eigenvalues than `members`.
std::optional<Meeting> meeting_in_one_point(const Track& track, const std::vector<int>& members,
                                            const std::vector<int>& cluster, double reach) {
  if (cluster.size() == members.size()) return std::nullopt;
  const std::vector<ComplexMatrix> part = part_of_track(track, cluster);
  if (part.empty()) return std::nullopt;
  const PartRounding rounding = rounding_of(track, part);
  auto meeting = common_crossing(part, rounding, reach);
  if (!meeting) meeting = common_collision(part, rounding.lambda, reach);
  if (meeting) meeting->members = cluster;
  return meeting;
}

}  // namespace

ComplexVector discriminant_of(const Track& track, const std::vector<int>& a, const std::vector<int>& b) {
  const std::vector<int> members = united(a, b);
  if (track.size() == 2 && members.size() == 2) return track.functions.row(1).transpose();
  if (with_bystanders(track.roots, members).size() == members.size()) {
    const std::vector<ComplexMatrix> part = part_of_track(track, members);
    if (!part.empty()) return discriminant_series(part, static_cast<Eigen::Index>(a.size()));
  }
  // Another eigenvalue is as close as these two. Each of them may be separated by itself, unless it is about
  // to meet another one: its series then says nothing about the distance of these two.
  constexpr double about_to_meet = 1e-2;
  double apart = INFINITY;
  for (const int i : a) {
    for (const int j : b) apart = std::min(apart, std::abs(track.roots[i] - track.roots[j]));
  }
  if (distance_from_others(track.roots, members) < about_to_meet * apart) return {};
  const std::vector<ComplexMatrix> first = part_of_track(track, a);
  const std::vector<ComplexMatrix> second = part_of_track(track, b);
  if (first.empty() || second.empty()) return {};
  return discriminant_series(mean_series(first), mean_series(second));
}

Meeting nearest_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b,
                        double reach, const MeetingThresholds& thresholds) {
  const std::vector<int> members = united(a, b);
  if (auto meeting = meeting_in_one_point(track, members, with_bystanders(track.roots, members), reach))
    return *meeting;
  const ComplexVector discriminant = discriminant_of(track, a, b);
  if (discriminant.size() == 0) return {};
  if (vanishes(discriminant, reach, member_resolution(track, members, reach))) {
    // The two coincide everywhere. They may meet others together: those within the square root of rounding,
    // to which multiple eigenvalues are known.
    constexpr double nearby = 1e-7;
    const std::vector<int> others = with_bystanders(track.roots, members, nearby);
    return meeting_in_one_point(track, members, others, reach).value_or(Meeting{});
  }
  const std::vector<Complex> roots = roots_by_magnitude(discriminant, reach);
  constexpr double farthest = 2.0;  // in units of the reach: the series is inaccurate beyond
  if (roots.empty() || std::abs(roots[0]) > farthest * std::abs(reach)) return {};
  Meeting meeting{.found = true, .puiseux = std::sqrt(discriminant[1]), .members = members};
  const std::vector<ComplexMatrix> part = part_of_track(track, members);
  const RootResolution known =
      resolution_of_roots(track, members, part.empty() ? track.series.Lambda : part, discriminant, reach);
  classify(roots, std::abs(reach), known, thresholds, meeting);
  const double slope = std::abs(jet(discriminant, roots[0])[1]);
  const bool is_double = roots.size() > 1 && !(0.5 * std::abs(roots[0] - roots[1]) > known.roots);
  if (known.defective && slope > 0.0 && !is_double) meeting.rounding = known.of_root_with(slope);
  return meeting;
}

double earlier_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b, double h) {
  constexpr double nearby = 0.2;    // share of the step up to which the series is accurate
  constexpr double apart = 1e-6;    // share of the step: a nearer root is the meeting at the point itself
  constexpr double on_axis = 1e-2;  // largest |Im| / |Re| of a root on the axis, since double roots split
  const ComplexVector discriminant = discriminant_of(track, a, b);
  double offset = 0.0;
  if (discriminant.size() == 0) return offset;
  for (const Complex root : polynomial_roots(discriminant)) {
    const bool is_earlier = root.real() * h < 0.0 && std::abs(root.imag()) <= on_axis * std::abs(root.real());
    const double distance = std::abs(root.real());
    if (is_earlier && distance > std::max(std::abs(offset), apart * std::abs(h)) &&
        distance < nearby * std::abs(h))
      offset = root.real();
  }
  return offset;
}

}  // namespace eigentrail
