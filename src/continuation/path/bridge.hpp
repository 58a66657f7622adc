// The equilibrium path over a branch point.
//
// Where another path crosses, [K f] has a kernel of two dimensions: no plane across the path makes the steady
// equations regular, neither on the point nor very near it, and Newton's method may arrive on the other path.
// The path itself is smooth there. It is computed at one point on either side, with as many coefficients as
// there are, and the polynomial that shares them is the path between them.
#pragma once

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/types.hpp"

namespace eigentrail {

constexpr double good_bridge = 2e-13;  ///< relative error at which a bridge is as good as solved points
constexpr double fair_bridge = 1e-10;  ///< the worst that is used where no better one is found

class Bridge {
 public:
  /// `left` and `right`: the path at two values of its coordinate, which is the traced parameter itself or
  /// the distance across a plane (`on_plane`).
  Bridge(double begin, double end, const Path& left, const Path& right, int traced, bool on_plane);
  Bridge() = default;

  /// Its state, for files that a trace goes on from.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.begin_, self.end_, self.parameters_, self.n_, self.traced_, self.on_plane_, self.interpolant_);
  }

  bool covers(double coordinate) const { return (coordinate - begin_) * (coordinate - end_) <= 0.0; }

  /// The path's series of the given order at a coordinate.
  Path path(double coordinate, int order) const;

  /// Magnitudes that errors are measured by.
  struct Sizes {
    double x = 1.0, lambda = 1.0, p = 1.0;
  };
  /// Estimated largest error of x, lambda and p.
  double error(const Sizes& sizes) const;

  double begin() const { return begin_; }
  double end() const { return end_; }

 private:
  double begin_ = 0.0, end_ = 0.0;
  Vector parameters_;
  Eigen::Index n_ = 0;
  int traced_ = 0;
  bool on_plane_ = false;
  HermiteInterpolant interpolant_;  ///< x, lambda, p less `parameters_`
};

}  // namespace eigentrail
