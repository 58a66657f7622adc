#include "stability/axis_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "eigentrail/continuation/eigenvalue_error.hpp"

namespace eigentrail {
namespace {

constexpr int axis_samples_per_step = 8;

/// The sample between two others at which the margin is extreme, by golden sections. `sense`: 1 for the
/// largest one, -1 for the least.
AxisSample extremum_between(const RecordedPath& path, const Judging& judging, const AxisSample& before,
                            const AxisSample& after, double sense) {
  // Leaves 4e-9 of the distance, and at a kink so much of the change of the margin.
  constexpr int sections = 40;
  constexpr double golden = 0.6180339887498949;
  double low = before.at.in_steps(), high = after.at.in_steps();
  const auto at = [&](double place) { return axis_sample(path, path.position_at(place), judging); };
  AxisSample first = at(high - golden * (high - low)), second = at(low + golden * (high - low));
  for (int i = 0; i < sections; ++i) {
    if (sense * first.margin > sense * second.margin) {
      high = second.at.in_steps();
      second = std::exchange(first, at(high - golden * (high - low)));
    } else {
      low = first.at.in_steps();
      first = std::exchange(second, at(low + golden * (high - low)));
    }
  }
  return sense * first.margin > sense * second.margin ? first : second;
}

/// Adds the extrema of the margin between samples, where it changes by more than its error.
void add_extrema(const RecordedPath& path, const Judging& judging, std::vector<AxisSample>& samples) {
  std::vector<AxisSample> extrema;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const AxisSample &before = samples[i - 1], &here = samples[i], &after = samples[i + 1];
    const double rise = here.margin - before.margin, fall = here.margin - after.margin;
    if (rise * fall > 0.0 && std::min(std::abs(rise), std::abs(fall)) > here.doubt)
      extrema.push_back(extremum_between(path, judging, before, after, rise > 0.0 ? 1.0 : -1.0));
  }
  const auto middle = samples.insert(samples.end(), extrema.begin(), extrema.end());
  std::inplace_merge(samples.begin(), middle, samples.end(),
                     [](const AxisSample& a, const AxisSample& b) { return a.at < b.at; });
}

/// Error bounds of the eigenvalues of a block at a place, 1/s, in the order of the block's modes: those of
/// the dense output, at a stored point those by rounding. `s`: the eigenvalues of all modes there.
Vector uncertainty(const RecordedPath& path, const DenseBlock& block, const PathPosition& at,
                   const ComplexVector& s, const EigenvalueAccuracy& accuracy) {
  Vector doubts(static_cast<Eigen::Index>(block.modes.size()));
  const bool exact = at.t == 0.0 || at.t == 1.0;
  if (!exact && block.size() > 1)
    return block_errors(block, path.steps[at.step].length, at.t, s, false, accuracy.tolerance,
                        accuracy.reference);
  for (Eigen::Index i = 0; i < doubts.size(); ++i) {
    const int mode = block.modes[static_cast<std::size_t>(i)];
    doubts[i] = exact ? path.rounding_at(at, mode) : accuracy.tolerance * scale_of(s[mode], accuracy);
  }
  return doubts;
}

}  // namespace

double scale_of(Complex s, const EigenvalueAccuracy& accuracy) {
  return std::max(std::abs(s), accuracy.reference);
}

AxisSample axis_sample(const RecordedPath& path, const PathPosition& at, const Judging& judging) {
  AxisSample result;
  result.at = at;
  result.exact = at.t == 0.0 || at.t == 1.0;
  const ComplexVector s = path.eigenvalues_at(at);
  double fastest = -INFINITY;
  for (const DenseBlock& block : path.steps[at.step].blocks) {
    const Vector doubts = uncertainty(path, block, at, s, judging.accuracy);
    for (std::size_t i = 0; i < block.modes.size(); ++i) {
      const int mode = block.modes[i];
      const double growth = s[mode].real();
      if (judging.modes[static_cast<std::size_t>(mode)] == Permanence::zero || !std::isfinite(growth))
        continue;
      const double doubt = doubts[static_cast<Eigen::Index>(i)];
      std::vector<int>& list = growth > doubt    ? result.unstable
                               : growth < -doubt ? result.decaying
                                                 : result.open;
      list.push_back(mode);
      if (!(growth > fastest)) continue;
      result.critical = mode;
      result.doubt = doubt;
      fastest = growth;
    }
  }
  result.margin = result.critical < 0 ? std::numeric_limits<double>::quiet_NaN() : -fastest;
  return result;
}

void add_samples(const RecordedPath& path, const Judging& judging, AxisStretch& stretch) {
  const PathPosition from = stretch.from.at, to = stretch.to.at;
  const auto add = [&](std::size_t step, double t) {
    stretch.samples.push_back(axis_sample(path, {step, t}, judging));
  };
  for (std::size_t step = from.step; step <= to.step; ++step) {
    const double low = step == from.step ? from.t : 0.0;
    const double high = step == to.step ? to.t : 1.0;
    if (low == 0.0 && (step > from.step || !stretch.from.on_axis) && high > 0.0) add(step, 0.0);
    if (high <= low) continue;
    for (int k = 0; k < axis_samples_per_step; ++k)
      add(step, low + (high - low) * (k + 0.5) / axis_samples_per_step);
  }
  if (!stretch.to.on_axis) add(to.step, to.t);
  add_extrema(path, judging, stretch.samples);
}

}  // namespace eigentrail
