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
  Matrix rough = {};  ///< the part of `interpolation` that does not vanish at the samples
  /// The rest at a value of the parameter, as a share of its largest value between two samples; refers to the
  /// model.
  std::function<double(double)> shape = {};

  /// The sum of both at the value p of the parameter on a step; infinite where it is not known.
  double at(std::size_t step, Eigen::Index mode, double p) const {
    const auto row = static_cast<Eigen::Index>(step);
    const double there =
        shape ? std::max(shape(p) * interpolation(row, mode), rough(row, mode)) : interpolation(row, mode);
    const double sum = there + digits(row, mode);
    return std::isnan(sum) ? INFINITY : sum;
  }

  /// The same for the whole step.
  double on_step(std::size_t step, Eigen::Index mode) const {
    const auto row = static_cast<Eigen::Index>(step);
    const double sum = interpolation(row, mode) + digits(row, mode);
    return std::isnan(sum) ? INFINITY : sum;
  }
};

}  // namespace eigentrail
