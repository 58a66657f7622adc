// Errors of the eigenvalues of a trace that come from the data of its model: samples and their digits.
#pragma once

#include <cmath>
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
  Matrix interpolation;                       ///< between the samples
  Matrix digits;                              ///< from the digits of the samples; zero if these are not known
  std::vector<EventInterval> intervals = {};  ///< per event of the trace

  /// The sum of both; infinite where it is not known.
  double at(std::size_t step, Eigen::Index mode) const {
    const auto row = static_cast<Eigen::Index>(step);
    const double sum = interpolation(row, mode) + digits(row, mode);
    return std::isnan(sum) ? INFINITY : sum;
  }
};

}  // namespace eigentrail
