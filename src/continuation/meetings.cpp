#include "continuation/meetings.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "continuation/shared_basis.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

constexpr double vanishing = 1e-13;  ///< a discriminant below this fraction of its natural size is zero
constexpr int degree_of_large_blocks = 24;
constexpr double beside = 0.05;  ///< of a step: how far off its ends a meeting is looked into

/// The number of eigenvalues of the block that are distinct somewhere among the sampled functions.
Eigen::Index distinct_eigenvalues(const std::vector<ComplexVector>& samples, double scale) {
  for (Eigen::Index r = samples.front().size(); r > 1; --r) {
    const double size = std::pow(scale, static_cast<double>(r * (r - 1)));
    for (const ComplexVector& functions : samples) {
      if (std::abs(block_discriminant(functions, r)) > vanishing * size) return r;
    }
  }
  return 1;
}

/// A pair that nears the real axis and turns back meets nothing.
bool pair_stays_apart(const Track& track, const HermiteInterpolant& functions, Complex t, double length,
                      double width) {
  return track.pair.is_real && track.size() == 2 && functions(0.5)[1].real() < 0.0 &&
         std::abs(t.imag() * length) > 1e-3 * width;
}

}  // namespace

std::vector<ExpectedMeeting> expected_meetings(const PathNode& left, const PathNode& right, double length,
                                               double width) {
  std::vector<ExpectedMeeting> meetings;
  for (std::size_t i = 0; i < left.tracks.size(); ++i) {
    const Track& track = left.tracks[i];
    if (track.size() < 2) continue;
    const DenseBlock block = block_on_step(left, right, i);
    const HermiteInterpolant functions(length, block.left, block.right);
    std::vector<ComplexVector> samples;
    for (const double t : {0.0, 0.13, 0.37, 0.61, 0.83, 1.0}) samples.push_back(functions(t));
    const Eigen::Index distinct = distinct_eigenvalues(samples, track.pair.Lambda.norm());
    if (distinct < 2) continue;
    const int degree =
        track.size() == 2 ? 2 * static_cast<int>(track.functions.cols()) - 1 : degree_of_large_blocks;
    const auto discriminant = [&](double t) { return block_discriminant(functions(t), distinct); };
    for (const Complex t : roots_near_unit_interval(discriminant, degree)) {
      // Double roots of the interpolant are off by the root of its error.
      const bool near_step = t.real() > -beside && t.real() < 1.0 + beside;
      if (!near_step || std::abs(t.imag() * length) > width) continue;
      if (pair_stays_apart(track, functions, t, length, width)) continue;
      meetings.push_back({i, std::clamp(t.real(), 1e-3, 1.0) * length});
    }
  }
  std::sort(meetings.begin(), meetings.end(), [](const ExpectedMeeting& a, const ExpectedMeeting& b) {
    return std::abs(a.distance) < std::abs(b.distance);
  });
  return meetings;
}

namespace {

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
  if (sum == 0.0) return roots;
  std::array<Complex, 2> near{-2.0 * series[0] / sum, -0.5 * sum / series[2]};
  for (std::size_t i = 0; i < std::min<std::size_t>(2, roots.size()); ++i) {
    if (!(std::abs(near[i]) < 0.03 * std::abs(reach))) continue;
    for (int k = 0; k < 3; ++k) {
      Complex value = 0.0;
      Complex slope = 0.0;
      for (Eigen::Index j = series.size() - 1; j >= 0; --j) {
        slope = slope * near[i] + value;
        value = value * near[i] + series[j];
      }
      // Double roots are as the quadratic has them.
      if (std::abs(slope) > 1e-6 * std::abs(series[1]) + 1e-12 * std::abs(series[2] * reach))
        near[i] -= value / slope;
    }
    roots[i] = near[i];
  }
  return roots;
}

/// Taylor coefficients of the discriminant from samples on a circle of radius `reach`.
ComplexVector discriminant_series(const Track& track, Eigen::Index distinct, double reach) {
  constexpr int samples = 32;
  ComplexVector series = ComplexVector::Zero(12);
  for (int i = 0; i < samples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / samples;
    const Complex h = reach * Complex(std::cos(angle), std::sin(angle));
    ComplexVector functions = track.functions.col(track.functions.cols() - 1);
    for (Eigen::Index k = track.functions.cols() - 2; k >= 0; --k)
      functions = functions * h + track.functions.col(k);
    const Complex value = block_discriminant(functions, distinct);
    for (Eigen::Index k = 0; k < series.size(); ++k) {
      const double turn = -angle * static_cast<double>(k);
      series[k] += value * Complex(std::cos(turn), std::sin(turn)) /
                   (samples * std::pow(reach, static_cast<double>(k)));
    }
  }
  return series;
}

/// The eigenvalues of a block that lie together at the point: the closest two and who is about as close to
/// them.
std::vector<int> closest_members(const ComplexVector& roots) {
  const Eigen::Index k = roots.size();
  std::vector<int> members(static_cast<std::size_t>(k));
  std::iota(members.begin(), members.end(), 0);
  if (k == 2) return members;
  const double gap = least_gap(roots);
  const double reach = std::max(10.0 * gap, 1e-5 * roots.cwiseAbs().maxCoeff());
  int centre = 0;
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(roots[i] - roots[j]) == gap) centre = i;
    }
  }
  std::erase_if(members, [&](int i) { return std::abs(roots[i] - roots[centre]) > reach; });
  return members;
}

/// det(Lambda - tau) at a distance from the point.
Complex product_of_distances(const Track& track, double h) {
  const ComplexVector functions = evaluate_series(track.functions, h);
  ComplexMatrix N = functions.reshaped(track.size(), track.size());
  N.diagonal().array() -= N.trace() / static_cast<double>(track.size());
  return N.determinant();
}

/// c of s = s* + c h^(1/m) + ... where all m eigenvalues of the block meet; zero where only some of them do.
Complex leading_coefficient(const Track& track, std::size_t meeting, double reach) {
  if (static_cast<Eigen::Index>(meeting) != track.size()) return 0.0;
  if (meeting == 2) return std::sqrt(track.functions(1, 1));
  const double h = 1e-4 * reach;
  const Complex slope = (product_of_distances(track, h) - product_of_distances(track, -h)) / (2.0 * h);
  const double sign = meeting % 2 == 0 ? -1.0 : 1.0;
  return std::pow(sign * slope, 1.0 / static_cast<double>(meeting));
}

/// Where all eigenvalues of a large block meet in one exceptional point the product of their distances from
/// the mean has a simple root, told to full accuracy; the discriminant's is a multiple one.
void sharpen(const Track& track, double reach, Meeting& meeting) {
  if (track.size() < 3 || static_cast<Eigen::Index>(meeting.members.size()) != track.size()) return;
  const double w = 1e-3 * std::abs(reach);
  const Complex middle = product_of_distances(track, 0.0);
  const Complex slope = (product_of_distances(track, w) - product_of_distances(track, -w)) / (2.0 * w);
  const Complex curvature =
      (product_of_distances(track, w) + product_of_distances(track, -w) - 2.0 * middle) / (w * w);
  if (!(std::abs(slope) > std::abs(curvature) * w)) return;
  const Complex root = -middle / slope;
  // From afar the double root of the discriminant appears split: as far as it is, the two may disagree.
  const double split = std::abs(Complex(meeting.offset, 0.0) - meeting.root);
  if (std::abs(root - meeting.offset) > std::max(1e-3 * std::abs(reach), 3.0 * split)) return;
  meeting.offset = root.real();
  meeting.kind = EventKind::collision;
  meeting.half_width = 0.0;
}

/// From the roots nearest to the point: one root on the axis, two that coincide there, or roots beside it.
void classify(const std::vector<Complex>& roots, double resolution, double noise, bool defective,
              Meeting& meeting) {
  const Complex first = roots[0];
  const bool has_second =
      roots.size() > 1 && std::abs(roots[1]) <= 1e3 * std::max(std::abs(first), resolution);
  meeting.root = first;
  meeting.offset = first.real();
  if (!has_second) {
    const bool on_axis = std::abs(first.imag()) <= noise;
    meeting.kind = on_axis ? EventKind::collision : EventKind::veering;
    meeting.half_width = on_axis ? 0.0 : std::abs(first.imag());
    return;
  }
  const Complex second = roots[1];
  const double separation = 0.5 * std::abs(first - second);
  if (separation <= 10.0 * resolution &&
      std::abs((first + second).imag()) > 20.0 * std::max(resolution, noise)) {
    meeting.found = false;  // they coincide at a complex parameter and pass each other on the real axis
  } else if (separation <= 10.0 * resolution) {
    meeting.kind = defective ? EventKind::collision : EventKind::crossing;
    meeting.offset = 0.5 * (first + second).real();
  } else if (std::abs(first.imag()) <= 1e-3 * separation && std::abs(second.imag()) <= 1e-3 * separation) {
    meeting.kind = EventKind::collision;  // two exceptional points close to each other; this one is nearer
  } else {
    meeting.kind = EventKind::veering;
    const bool around = first.imag() * second.imag() < 0.0;
    if (around) meeting.offset = 0.5 * (first + second).real();
    meeting.half_width =
        around ? 0.5 * (std::abs(first.imag()) + std::abs(second.imag())) : std::abs(first.imag());
  }
}

}  // namespace

Meeting nearest_meeting(const Track& track, double reach) {
  Meeting meeting;
  const double scale = track.pair.Lambda.norm();
  ComplexVector series;
  if (track.size() == 2) {
    series = track.functions.row(1).transpose();
  } else {
    std::vector<ComplexVector> samples;
    for (const double h : {-reach, -0.4 * reach, 0.6 * reach, reach}) {
      samples.push_back(evaluate_series(track.functions, h));
    }
    const Eigen::Index distinct = distinct_eigenvalues(samples, scale);
    if (distinct < 2) return meeting;
    series = discriminant_series(track, distinct, reach);
  }
  const std::vector<Complex> roots = roots_by_magnitude(series, reach);
  if (roots.empty() || std::abs(roots[0]) > 2.0 * std::abs(reach)) return meeting;
  meeting.found = true;
  // Lambda is known to rounding times the condition of the block; what follows for the roots of the
  // discriminant.
  const ComplexMatrix centred =
      track.pair.Lambda - track.roots.mean() * ComplexMatrix::Identity(track.size(), track.size());
  // The condition is normwise and overrates graded pencils.
  constexpr double worst_condition = 100.0;
  const double rounding = 4e-15 * scale * std::clamp(track.pair.condition, 1.0, worst_condition);
  const double slope = track.series.Lambda.size() > 1 ? track.series.Lambda[1].norm() : 1.0;
  double resolution = slope > 0.0 ? rounding / slope : 0.0;
  double noise = std::abs(series[1]) > 0.0
                     ? 10.0 * rounding * std::max(centred.norm(), rounding) / std::abs(series[1])
                     : 0.0;
  // The discriminant of a defective block is known to rounding times its size: double roots to the root of
  // that.
  const double curvature = std::abs(series[2]);
  const bool defective = centred.norm() > 1e-6 * std::max(scale, 1e-3 * slope * std::abs(reach));
  if (track.size() == 2 && defective && curvature > 0.0) {
    resolution = std::max(resolution, std::sqrt(4.0 * rounding * centred.norm() / curvature));
  }
  if (track.size() > 2) {
    // A discriminant formed from power sums tells double roots by half the digits only.
    resolution = std::max(resolution, 1e-7 * std::abs(reach));
    noise = std::max(noise, 1e-7 * std::abs(reach));
  }
  classify(roots, resolution, noise, defective, meeting);
  meeting.members = closest_members(track.roots);
  meeting.puiseux = leading_coefficient(track, meeting.members.size(), reach);
  if (centred.norm() > 1e-3 * scale) sharpen(track, reach, meeting);
  return meeting;
}

}  // namespace eigentrail
