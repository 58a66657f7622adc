// A norm in which an operator that is far from normal is about as large as its eigenvalues.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The norm |S^-1 x|, where S = S_1 S_2 ... stretches one direction after the other: S_i = I + (a_i - 1) u_i
/// u_i^H. If A is large only because it maps some v to a multiple of u, which it maps to little, the norm of
/// S^-1 A S with a large stretch of u is far below that of A.
class AdaptedNorm {
 public:
  /// Stretches a direction u of length one by a >= 1.
  void stretch(ComplexVector u, double a) { stretches_.push_back({std::move(u), a}); }

  void apply(ComplexVector& x) const {
    for (auto it = stretches_.rbegin(); it != stretches_.rend(); ++it) it->scale(x, it->factor);
  }
  void apply_inverse(ComplexVector& x) const {
    for (const Stretch& one : stretches_) one.scale(x, 1.0 / one.factor);
  }
  /// S^H and S^-H.
  void apply_adjoint(ComplexVector& x) const {
    for (const Stretch& one : stretches_) one.scale(x, one.factor);
  }
  void apply_inverse_adjoint(ComplexVector& x) const {
    for (auto it = stretches_.rbegin(); it != stretches_.rend(); ++it) it->scale(x, 1.0 / it->factor);
  }

  /// Bound of |S|.
  double largest_factor() const {
    double largest = 1.0;
    for (const Stretch& one : stretches_) largest *= one.factor;
    return largest;
  }

 private:
  struct Stretch {
    ComplexVector direction;
    double factor;

    void scale(ComplexVector& x, double by) const { x += ((by - 1.0) * direction.dot(x)) * direction; }
  };
  std::vector<Stretch> stretches_;
};

}  // namespace eigentrail
