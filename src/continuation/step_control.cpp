#include "eigentrail/continuation/step_control.hpp"

namespace eigentrail {
namespace {

constexpr double aim = 0.3;        ///< aimed-at estimate / tolerance
constexpr double largest_growth = 2.5;
constexpr double smallest_growth = 0.2;
constexpr double smallest_step = 1e-11;  ///< of the range

}  // namespace

StepControl::StepControl(double range, int order, double first_step, double max_step)
    : order_(order), step_(std::min(first_step, max_step)), max_step_(max_step), min_step_(smallest_step * std::abs(range)) {}

double StepControl::propose(double remaining) const {
  const double step = std::min(step_, max_step_);
  if (remaining <= 1.02 * step) return remaining;
  return remaining < 2.0 * step ? 0.5 * remaining : step;
}

double StepControl::estimate(double miss, double h) const {
  const double ratio = has_history() ? 0.25 / (1.0 + last_ / h) : 0.25;
  return miss * std::pow(ratio, order_ + 1);
}

double StepControl::factor(double error) const {
  // The first step compares with a Taylor polynomial, whose error has half the order.
  const double exponent = has_history() ? 2.0 * order_ + 2.0 : order_ + 1.0;
  return std::clamp(std::pow(aim / std::max(error, 1e-30), 1.0 / exponent), smallest_growth, largest_growth);
}

void StepControl::accept(double h, double error) {
  const double growth = factor(error);
  step_ = std::min(h * (rejected_ ? std::min(growth, 1.0) : growth), max_step_);
  last_ = h;
  rejected_ = false;
}

void StepControl::reject(double h, double error) {
  step_ = h * (std::isfinite(error) ? std::min(factor(error), 0.9) : 0.4);
  rejected_ = true;
}

}  // namespace eigentrail
