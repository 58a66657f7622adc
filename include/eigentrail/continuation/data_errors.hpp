// Errors of the eigenvalues of a trace that come from the data of its model: samples and their digits.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Values of the parameter, in its unit, between which an event lies as far as the errors of the data tell;
/// within the range of the trace. NaN where the kind of the event has no such interval.
struct EventInterval {
  double from = NAN;
  double to = NAN;
};

/// Bounds, absolute, 1/s; a row per step and a column per mode. NaN where a mode does not exist. They hold to
/// first order in the errors of the matrices, and stand beside the tolerance of the trace.
struct DataErrors {
  Matrix interpolation;                       ///< between the samples, for the whole step
  Matrix digits;                              ///< from the digits of the samples; zero if these are not known
  std::vector<EventInterval> intervals = {};  ///< per event of the trace

  // These are not stored:
  Matrix rough = {};                      ///< the part of `interpolation` that does not vanish at the samples
  Matrix growth = {}, rough_growth = {};  ///< the same two of Re s
  /// The rest at a value of the parameter, as a share of its largest value between two samples; refers to the
  /// model.
  std::function<double(double)> shape = {};

  /// The sum of both on a step; infinite where it is not known.
  double on_step(std::size_t step, Eigen::Index mode) const {
    const auto row = static_cast<Eigen::Index>(step);
    return known_or_infinite(interpolation(row, mode) + digits(row, mode));
  }

  /// The same at the value p of the parameter on the step.
  double at(std::size_t step, Eigen::Index mode, double p) const {
    if (!shape) return on_step(step, mode);
    const auto row = static_cast<Eigen::Index>(step);
    const double there = std::max(shape(p) * interpolation(row, mode), rough(row, mode));
    return known_or_infinite(there + digits(row, mode));
  }
  /// The error of Re s there.
  double growth_at(std::size_t step, Eigen::Index mode, double p) const {
    if (!shape) return on_step(step, mode);
    const auto row = static_cast<Eigen::Index>(step);
    const double there = std::max(shape(p) * growth(row, mode), rough_growth(row, mode));
    return known_or_infinite(there + digits(row, mode));
  }

  static double known_or_infinite(double error) { return std::isnan(error) ? INFINITY : error; }
};

}  // namespace eigentrail
