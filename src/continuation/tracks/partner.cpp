#include "continuation/tracks/partner.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"

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
    const bool same_chart = other.pair.chart == track.pair.chart;
    const double gap =
        gap_between(track.roots, same_chart ? other.roots : ComplexVector(other.roots.cwiseInverse()));
    if (gap < nearest.distance) nearest = {false, i, gap};
  }
  if (!std::isfinite(nearest.distance)) return std::nullopt;
  return nearest;
}

}  // namespace eigentrail
