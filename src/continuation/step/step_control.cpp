#include "eigentrail/continuation/step_control.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

constexpr double aim = 0.3;  ///< error / accepted error that a step aims at
constexpr double largest_growth = 2.5;
constexpr double smallest_growth = 0.2;
constexpr double least_error = 1e-10;  ///< smaller errors are treated as this

}  // namespace

StepControl::StepControl(int order, double first_step, double max_step, double min_step)
    : order_(order),
      step_(std::clamp(first_step, min_step, max_step)),
      max_step_(max_step),
      min_step_(min_step) {}

double StepControl::propose(double remaining) const {
  const double step = std::min(step_, max_step_);
  if (remaining <= std::min(1.02 * step, max_step_)) return remaining;
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
    // Steps of the same length ratio again would meet an error that grew by the same factor again.
    factor /= std::max(trend(h, error), 1.0);
  }
  if (rejected_) factor = std::min(factor, 1.0);
  step_ = std::clamp(h * std::clamp(factor, smallest_growth, largest_growth), min_step_, max_step_);
  last_step_ = h;
  last_error_ = error;
  rejected_ = false;
}

void StepControl::reject(double h, double error) {
  step_ = h * (std::isfinite(error) ? std::clamp(growth(error), smallest_growth, 0.9) : 0.4);
  rejected_ = true;
}

}  // namespace eigentrail
