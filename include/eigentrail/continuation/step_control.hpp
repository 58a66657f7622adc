// Step length control by the error of the dense output.
//
// The error of the interpolant of order q on a step of length h is of the order h^(2q+2). So the length
// changes by the (2q+2)-th root of accepted error / error. If the error grew faster than that from the
// last step to this one, the same growth is assumed for the next step (predictive control, Gustafsson, ACM
// Trans. Math. Softw. 20, 1994).
#pragma once

namespace eigentrail {

class StepControl {
 public:
  /// Lengths are positive, in the coordinate along the path. Below `min_step` the trace gives up. `order` is
  /// q.
  StepControl(int order, double first_step, double max_step, double min_step);
  StepControl() : StepControl(1, 1.0, 1.0, 0.0) {}

  /// Visits all members, for saving and restoring the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.order_, self.step_, self.max_step_, self.min_step_, self.last_step_, self.last_error_,
          self.rejected_);
  }

  /// Length of the next step if `remaining` is left of the range. The remaining length is taken in one step,
  /// or halved, if a full step would leave a very short last one.
  double propose(double remaining) const;

  /// Call after an accepted step of length h with `error` = estimated error / accepted error.
  void accept(double h, double error);

  /// Call after a rejected step of length h: too inaccurate (`error` > 1), or failed (`error` infinite).
  void reject(double h, double error);

  /// Begins again with steps of length h, when what made them short is gone.
  void restart(double h);

  /// Whether the next step would be shorter than `min_step`.
  bool exhausted() const { return !(step_ >= min_step_ && step_ > 0.0); }

  /// Length of the next step that the accuracy allows.
  double step() const { return step_; }

 private:
  /// Ratio of step lengths that brings `error` to the error that steps aim at.
  double growth(double error) const;
  /// Ratio of the error of a step of length h to the last step's error scaled to that length, as a ratio of
  /// lengths (its (2q+2)-th root).
  double trend(double h, double error) const;

  int order_;
  double step_;
  double max_step_;
  double min_step_;
  double last_step_ = 0.0;   ///< length of the last accepted step, 0 before the first
  double last_error_ = 0.0;  ///< its error / accepted error
  bool rejected_ = false;    ///< the last attempt was rejected: the next accepted step does not grow
};

}  // namespace eigentrail
