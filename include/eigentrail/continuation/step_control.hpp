// Step length from the error of the dense output.
//
// The error of the interpolant of order q on a step of length h is of the order h^(2q+2), so the step grows
// or shrinks with the (2q+2)-th root of the error, with the trend of the last two steps taken on (Gustafsson,
// ACM Trans. Math. Softw. 20, 1994).
#pragma once

namespace eigentrail {

class StepControl {
 public:
  /// Steps are positive lengths along the trace; below `min_step` they mean nothing any more.
  StepControl(int order, double first_step, double max_step, double min_step);
  StepControl() : StepControl(1, 1.0, 1.0, 0.0) {}

  /// Its state, for files that a trace goes on from.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.order_, self.step_, self.max_step_, self.min_step_, self.last_step_, self.last_error_,
          self.rejected_);
  }

  /// Length of the next step with `remaining` ahead; lands on the end without a sliver before it.
  double propose(double remaining) const;

  /// After an accepted step with estimated error / accepted error = `error`.
  void accept(double h, double error);

  /// After a step that was too inaccurate (`error` > 1), or failed altogether (`error` infinite).
  void reject(double h, double error);

  /// Whether steps have become too short to mean anything.
  bool exhausted() const { return step_ < min_step_; }

  /// Length of the next step as far as accuracy is concerned.
  double step() const { return step_; }

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
