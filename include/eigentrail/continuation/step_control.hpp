// Step length from the error of the dense output.
//
// Two estimates of that error are at hand, and the larger counts. One is told by the interpolant itself
// (HermiteInterpolant::estimated_error). The other comes from the miss of the previous step's interpolant,
// extrapolated to the new point: it misses by s^(2q+2)/(2q+2)! (h (h + h_old))^(q+1), while inside the new
// step the error is at most s^(2q+2)/(2q+2)! (h^2/4)^(q+1). The step then grows or shrinks with the (2q+2)-th
// root of the error, with the trend of the last two steps taken on (Gustafsson, ACM Trans. Math. Softw. 20,
// 1994).
#pragma once

namespace eigentrail {

class StepControl {
 public:
  /// Steps are positive lengths along the trace; below `min_step` they mean nothing any more.
  StepControl(int order, double first_step, double max_step, double min_step);

  /// Length of the next step with `remaining` ahead; lands on the end without a sliver before it.
  double propose(double remaining) const;

  /// Error inside a step of length h from the predictor's `miss` at its end, both as fractions of the
  /// accepted error. The first step has no previous interpolant and compares with the Taylor polynomial.
  double error_from_miss(double h, double miss) const;

  /// After an accepted step with estimated error / accepted error = `error`.
  void accept(double h, double error);

  /// After a step that was too inaccurate (`error` > 1), or failed altogether (`error` infinite).
  void reject(double h, double error);

  /// Whether steps have become too short to mean anything.
  bool exhausted() const { return step_ < min_step_; }

 private:
  double growth(double error) const;
  /// By how much the error of a step of length h exceeds what the last step's error scales to, as a ratio of
  /// lengths.
  double trend(double h, double error) const;

  int order_;
  double step_;
  double max_step_;
  double min_step_;
  double last_step_ = 0.0;   ///< length of the last accepted step, 0 before the first
  double last_error_ = 0.0;  ///< its error / accepted error
  bool rejected_ = false;    ///< the last attempt was rejected: do not grow at once
};

}  // namespace eigentrail
