#include "eigentrail/continuation/step_control.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Error / accepted error that steps aim at. With a larger value more steps are rejected, with a smaller one
/// steps are shorter than necessary.
constexpr double aim = 0.3;
/// Limits of the ratio of successive step lengths, against estimates that are far off. With wider limits one
/// poor estimate costs a rejected or a very short step; with narrower ones the length adapts more slowly.
constexpr double largest_growth = 2.5;
constexpr double smallest_growth = 0.2;
/// A rejected step is shortened at least to this share. A value near one repeats almost the same step.
constexpr double largest_share_of_rejected = 0.9;
/// Share to which a step is shortened whose error is not known, because it failed altogether.
constexpr double share_of_failed = 0.4;
/// Errors below this are treated as this: they are rounding, and their ratios mean nothing.
constexpr double least_error = 1e-10;
/// A step may be longer by this factor to reach the end of the range: a very short last step is avoided.
/// The error grows by 1.02^(2q+2), at most 22 %, which the distance between `aim` and one allows for.
constexpr double stretch_to_end = 1.02;
/// The same for a step of the largest length, which is longer by rounding only: places that are solved for
/// are not exact, and rounding should not decide between one step and two.
constexpr double stretch_of_largest = 1.0 + 1e-9;

}  // namespace

StepControl::StepControl(int order, double first_step, double max_step, double min_step)
    : order_(order),
      step_(std::clamp(first_step, min_step, max_step)),
      max_step_(max_step),
      min_step_(min_step) {}

double StepControl::propose(double remaining) const {
  const double step = std::min(step_, max_step_);
  if (remaining <= std::min(stretch_to_end * step, stretch_of_largest * max_step_)) return remaining;
  // Two equal steps instead of a full one and a short one.
  return remaining < 2.0 * step ? 0.5 * remaining : step;
}

double StepControl::trend(double h, double error) const {
  return (last_step_ / h) * std::pow(error / last_error_, 1.0 / (2.0 * order_ + 2.0));
}

double StepControl::growth(double error) const {
  return std::pow(aim / error, 1.0 / (2.0 * order_ + 2.0));
}

void StepControl::accept(double h, double error) {
  error = std::max(error, least_error);
  double factor = growth(error);
  if (last_step_ > 0.0) {
    // The error grew faster than with the step length. The same growth is assumed for the next step.
    factor /= std::max(trend(h, error), 1.0);
  }
  if (rejected_) factor = std::min(factor, 1.0);
  step_ = std::clamp(h * std::clamp(factor, smallest_growth, largest_growth), min_step_, max_step_);
  last_step_ = error > least_error ? h : 0.0;
  last_error_ = error;
  rejected_ = false;
}

void StepControl::restart(double h) {
  step_ = std::clamp(h, min_step_, max_step_);
  last_step_ = 0.0;
  rejected_ = false;
}

void StepControl::reject(double h, double error) {
  step_ = h * (std::isfinite(error) ? std::clamp(growth(error), smallest_growth, largest_share_of_rejected)
                                    : share_of_failed);
  rejected_ = true;
}

}  // namespace eigentrail
