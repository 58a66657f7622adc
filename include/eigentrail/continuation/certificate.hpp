// Evidence that the pair at the end of a step is the continuation of the pair at its beginning.
//
// Newton-Kantorovich tube (radii polynomial, e.g. van den Berg & Lessard, Notices AMS 62, 2015): on the
// pencil interpolated between the two points, with B = J^-1 at the middle of a piece of the step and the
// interpolated pair U(t), bounds Y >= |B F(U)|, Z1 >= |I - B J|, Z2 >= |B F''| are formed at sample points.
// Where some r > 0 has Y + Z1 r + Z2 r^2/2 <= r there is one exact pair within r of U(t), throughout the
// piece. Pieces that fail are halved. Nothing else can then be met on the way: two pairs cannot be exchanged.
//
// The bounds are sampled, and norms are estimated by power iteration: evidence, not interval arithmetic.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// The pencil between two neighbouring points, in the reduced coordinates of the left one. Costs no model
/// evaluation. Keeps what it has computed; safe to use by several threads at once.
class StepPencil {
 public:
  /// `length` is the step in the path's coordinate; both points must outlive the object.
  StepPencil(const PathNode& left, const PathNode& right, double length);

  /// What is interpolated at one place of the step.
  struct Sample {
    Sample(Vector hermite, ReducedPencil interpolated)
        : weights(std::move(hermite)), pencil(std::move(interpolated)), at(pencil) {}
    Sample(const Sample&) = delete;  // refers to itself

    Vector weights;        ///< of the coefficients at both ends, left, then right
    ReducedPencil pencil;  ///< one coefficient of each
    PencilAtPoint at;      ///< the same in the finite chart, with its norms
  };
  /// At t in [0, 1].
  std::shared_ptr<const Sample> at(double t) const;

  const PathNode& left() const { return left_; }
  bool has_constant_mass() const { return left_.pencil.M.size() == 1 && right_.M.size() == 1; }

 private:
  std::shared_ptr<const Sample> sample(double t) const;
  Matrix interpolate(const MatrixSeries& left, const MatrixSeries& right, const Vector& weights) const;

  const PathNode& left_;
  double length_;
  Eigen::Index count_;  ///< coefficients at each end
  ReducedPencil right_;
  mutable std::mutex mutex_;
  /// By t: every block of a step looks at the same places.
  mutable std::map<double, std::shared_ptr<const Sample>> samples_;
};

/// Whether the tube closes on the whole step from `left` to `right`, the same block at both ends. `gap` is
/// the distance to the nearest other known eigenvalue, which balances vector and eigenvalue in the norm.
bool certify_step(const StepPencil& pencil, const Track& left, const Track& right, double gap,
                  RunCounts& counts);

}  // namespace eigentrail
