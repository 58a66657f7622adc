// Step length from the error of the dense output.
//
// The eigenvalue extrapolated from the previous step's Hermite interpolant misses the corrected one by
//     s^(2q+2)/(2q+2)! (h (h + h_old))^(q+1);   inside the new step the interpolant's error is at most
//     s^(2q+2)/(2q+2)! (h^2 / 4)^(q+1).
// Their ratio (1/4 / (1 + h_old/h))^(q+1) turns the observed miss into the estimate, and h grows or shrinks with its
// (2q+2)-th root, as in a code for ordinary differential equations.
#pragma once

#include <algorithm>
#include <cmath>

namespace eigentrail {

class StepControl {
 public:
  /// `range`: signed length of the trace; steps are positive lengths along it.
  StepControl(double range, int order, double first_step, double max_step);

  /// Length of the next step from a point with `remaining` ahead; lands on the end without a sliver before it.
  double propose(double remaining) const;

  /// Estimated error of the dense output on a step of length h from the miss of the predictor at its end.
  double estimate(double miss, double h) const;

  /// After an accepted step with estimated error / tolerance = `error`.
  void accept(double h, double error);

  /// After a step that was too inaccurate (`error` > 1), or failed altogether (`error` infinite).
  void reject(double h, double error);

  /// Whether steps have become too short to mean anything.
  bool exhausted() const { return step_ < min_step_; }

  bool has_history() const { return last_ > 0.0; }

 private:
  double factor(double error) const;

  int order_;
  double step_;
  double max_step_;
  double min_step_;
  double last_ = 0.0;     ///< length of the last accepted step
  bool rejected_ = false; ///< the last attempt was rejected: do not grow at once
};

}  // namespace eigentrail
