#include "eigentrail/stability/undecided_ranges.hpp"

#include <algorithm>
#include <cmath>

#include "core/bisection.hpp"
#include "eigentrail/stability/permanent_modes.hpp"

namespace eigentrail {
namespace {

constexpr int range_samples_per_step = 8;
/// The cause of an end of a range beyond which the errors leave the stability open.
constexpr const char* cause = "data error";

/// What the intervals of all real parts say at a place.
struct RangeSample {
  double place = 0.0;  ///< in steps from the first point
  Stability verdict = Stability::undecided;
  double margin = 0.0;  ///< -max Re s
  int critical = -1;    ///< the mode with the largest Re s
};

/// Places, in steps from the first point.
struct Stretch {
  RangeSample from, to;
};

class Sampler {
 public:
  Sampler(const RecordedPath& path, const DataErrors& errors, const EigenvalueAccuracy& accuracy)
      : path_(path), errors_(errors), accuracy_(accuracy), permanence_(permanence_of_modes(path, accuracy)) {}

  double parameter(double place) const { return path_.parameter_at(path_.position_at(place)); }

  RangeSample at(double place) const {
    const PathPosition here = path_.position_at(place);
    const ComplexVector s = path_.eigenvalues_at(here);
    double lowest = -INFINITY, highest = -INFINITY, fastest = -INFINITY;
    RangeSample sample{place};
    for (Eigen::Index mode = 0; mode < s.size(); ++mode) {
      if (permanence_[static_cast<std::size_t>(mode)] == Permanence::zero || !std::isfinite(s[mode].real()))
        continue;
      // Where the data are as good as exact, the tolerance of the trace alone leaves nothing undecided.
      const double promised = accuracy_.tolerance * std::max(std::abs(s[mode]), accuracy_.reference);
      const double data = errors_.growth_at(here.step, mode, path_.parameter_at(here));
      const double error = data > promised ? data + promised : 0.0;
      lowest = std::max(lowest, s[mode].real() - error);
      highest = std::max(highest, s[mode].real() + error);
      if (s[mode].real() <= fastest) continue;
      fastest = s[mode].real();
      sample.critical = static_cast<int>(mode);
    }
    sample.margin = -fastest;
    if (highest <= 0.0) sample.verdict = Stability::stable;
    if (lowest > 0.0) sample.verdict = Stability::unstable;
    return sample;
  }

  /// The place between two samples at which the verdict `undecided` begins or ends.
  RangeSample edge(const RangeSample& inside, const RangeSample& outside) const {
    constexpr int halvings = 45;
    return at(bisected(inside.place, outside.place, halvings, [this](double place) {
                return at(place).verdict == Stability::undecided;
              }).last);
  }

 private:
  const RecordedPath& path_;
  const DataErrors& errors_;
  EigenvalueAccuracy accuracy_;
  std::vector<Permanence> permanence_;
};

/// Samples all along the path, and at the events on the imaginary axis.
std::vector<RangeSample> all_samples(const Sampler& sampler, const RecordedPath& path,
                                     const std::vector<Event>& events) {
  std::vector<double> places;
  for (std::size_t step = 0; step < path.steps.size(); ++step) {
    for (int k = 0; k < range_samples_per_step; ++k)
      places.push_back(static_cast<double>(step) + static_cast<double>(k) / range_samples_per_step);
  }
  places.push_back(static_cast<double>(path.steps.size()));
  for (const Event& event : events) {
    if (event.kind != EventKind::flutter && event.kind != EventKind::divergence) continue;
    for (const PathPosition& at : path.positions(event.p)) places.push_back(at.in_steps());
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<RangeSample> samples;
  for (const double place : places) samples.push_back(sampler.at(place));
  return samples;
}

std::vector<Stretch> undecided_stretches(const Sampler& sampler, const std::vector<RangeSample>& samples) {
  std::vector<Stretch> found;
  const auto open = [&](std::size_t i) { return samples[i].verdict == Stability::undecided; };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!open(i)) continue;
    const std::size_t first = i;
    while (i + 1 < samples.size() && open(i + 1)) ++i;
    found.push_back({first == 0 ? samples[0] : sampler.edge(samples[first], samples[first - 1]),
                     i + 1 == samples.size() ? samples[i] : sampler.edge(samples[i], samples[i + 1])});
  }
  return found;
}

}  // namespace

std::vector<StableRange> with_undecided(const std::vector<StableRange>& ranges, const RecordedPath& path,
                                        const std::vector<Event>& events, const DataErrors& errors,
                                        const EigenvalueAccuracy& accuracy) {
  if (path.steps.empty()) return ranges;
  const Sampler sampler(path, errors, accuracy);
  const std::vector<RangeSample> samples = all_samples(sampler, path, events);
  const bool ascends = path.p.back() >= path.p.front();
  const auto before = [ascends](double a, double b) { return ascends ? a < b : a > b; };
  const auto edge = [&](const RangeSample& at) {
    return RangeEnd{sampler.parameter(at.place), cause, at.margin, at.critical};
  };

  std::vector<StableRange> open;
  for (const Stretch& stretch : undecided_stretches(sampler, samples)) {
    StableRange range{Stability::undecided, edge(stretch.from), edge(stretch.to), 0.0, 0.0, 0.0, true};
    if (stretch.from.place == 0.0) range.from.cause = "start";
    if (stretch.to.place == static_cast<double>(path.steps.size())) range.to.cause = "end";
    const bool marginal = std::any_of(ranges.begin(), ranges.end(), [&](const StableRange& other) {
      return other.kind == Stability::marginal && before(other.from.p, range.to.p) &&
             before(range.from.p, other.to.p);
    });
    if (marginal) continue;
    range.begin_margins();
    range.include(range.to.margin, range.to.p);
    open.push_back(range);
  }

  // A part of a stable range with its margins.
  const auto with_margins = [&](StableRange part) {
    part.begin_margins();
    for (const RangeSample& sample : samples) {
      const double p = sampler.parameter(sample.place);
      if (before(part.from.p, p) && before(p, part.to.p)) part.include(sample.margin, p);
    }
    part.include(part.to.margin, part.to.p);
    return part;
  };
  std::vector<StableRange> result = open;
  for (const StableRange& range : ranges) {
    StableRange rest = range;
    bool is_left = true;
    for (const StableRange& hole : open) {
      if (!is_left || !before(hole.from.p, rest.to.p) || !before(rest.from.p, hole.to.p)) continue;
      StableRange part = rest;
      part.to = hole.from;
      rest.from = hole.to;
      part.to.cause = rest.from.cause = cause;
      if (before(part.from.p, part.to.p)) result.push_back(with_margins(part));
      is_left = before(rest.from.p, rest.to.p);
    }
    if (is_left) result.push_back(rest.from.p == range.from.p ? rest : with_margins(rest));
  }
  std::stable_sort(result.begin(), result.end(),
                   [&](const StableRange& a, const StableRange& b) { return before(a.from.p, b.from.p); });
  return result;
}

}  // namespace eigentrail
