// Bridge: a polynomial representation of the equilibrium path over a branch point.
//
// Where another path crosses, [K f], with the force f of the traced parameter, has a kernel of two
// dimensions. The steady equations are then singular for every plane across the path, and nearly so close to
// the point, and Newton's method may converge to the other path. The path itself is smooth there. It is
// computed at one point on either side with series of the highest order. Between them it is the polynomial
// that agrees with both series (dense_output.hpp).
#pragma once

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Relative error of a bridge that is as accurate as solved points.
constexpr double good_bridge = 2e-13;
/// Largest relative error of a bridge that is used where no better one is found.
constexpr double fair_bridge = 1e-10;

class Bridge {
 public:
  /// `left` and `right`: series of the path at the coordinates `begin` and `end`. The coordinate is the
  /// traced parameter itself or the distance across a plane (`on_plane`). `traced`: index of the traced
  /// parameter.
  Bridge(double begin, double end, const Path& left, const Path& right, int traced, bool on_plane);
  Bridge() = default;

  /// Visits all members, for saving and restoring the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.begin_, self.end_, self.parameters_, self.n_, self.traced_, self.on_plane_, self.interpolant_);
  }

  /// Whether a coordinate lies between both ends.
  bool covers(double coordinate) const { return (coordinate - begin_) * (coordinate - end_) <= 0.0; }

  /// Series of the path of the given order at a coordinate.
  Path path(double coordinate, int order) const;

  /// Magnitudes by which errors are divided.
  struct Sizes {
    double x = 1.0, lambda = 1.0, p = 1.0;
  };
  /// Largest estimated error of x, lambda and p, each divided by its magnitude.
  double error(const Sizes& sizes) const;

  double begin() const { return begin_; }
  double end() const { return end_; }

 private:
  double begin_ = 0.0, end_ = 0.0;
  Vector parameters_;
  Eigen::Index n_ = 0;
  int traced_ = 0;
  bool on_plane_ = false;
  HermiteInterpolant interpolant_;  ///< of x, lambda, and p less its value in `parameters_`
};

}  // namespace eigentrail
