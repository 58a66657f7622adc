// Evidence that the invariant pair at the end of a step is the continuation of the pair at its beginning.
//
// Newton-Kantorovich test (radii polynomial, e.g. van den Berg & Lessard, Notices AMS 62, 2015). U(t) is the
// pair interpolated between the two points, F the equations of an invariant pair on the pencil interpolated
// in the same way, J the Jacobian of F. With B = J^-1 at the middle of a piece of the step, the bounds
//
//     Y >= |B F(U)|,     Z1 >= |I - B J|,     Z2 >= |B F''|
//
// are evaluated at sample points of the piece. If some r > 0 satisfies Y + Z1 r + Z2 r^2/2 <= r, exactly one
// pair lies within r of U(t), on the whole piece. Any norm serves; one that belongs to the piece makes the
// bounds far smaller where eigenvalues are sensitive or stiffnesses far apart (ball_norm.hpp,
// modal_bounds.hpp). The pairs within r are the Newton-Kantorovich ball about U(t), and the
// test closes if there is such an r. Pieces on which it does not close are halved. If it closes on all
// pieces, no other pair can have been exchanged with this one.
//
// The bounds are sampled, and norms are estimated by power iteration. The result is evidence, not a proof by
// interval arithmetic.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

class EnergyNorm;

/// The pencil between two neighbouring points, in the reduced coordinates of the left point: Hermite
/// interpolation of the series at both points, without evaluations of the model. Samples are cached. Several
/// threads may use one object at the same time.
class StepPencil {
 public:
  /// `length` is the step in the path's coordinate; both points must outlive the object. `part`: of the
  /// equations, where they fall apart.
  StepPencil(const PathNode& left, const PathNode& right, double length, int part = 0);

  /// The interpolated pencil at one value of t.
  struct Sample {
    Sample(Vector hermite, ReducedPencil interpolated)
        : weights(std::move(hermite)), pencil(std::move(interpolated)), at(pencil) {}
    Sample(const Sample&) = delete;  // refers to itself

    Vector weights;        ///< Hermite weights of the series coefficients: left end, then right end
    ReducedPencil pencil;  ///< M, C and K as series of order 0
    PencilAtPoint at;  ///< the same pencil in the finite chart, with its norms, and bands where it has them
  };
  /// The sample at t in [0, 1].
  std::shared_ptr<const Sample> at(double t) const;

  /// The energy norm at the middle of the step, by a shift of the magnitude of the followed
  /// eigenvalues. Null if there is none. Computed when it is first asked for.
  std::shared_ptr<const EnergyNorm> energy_norm() const;

  const PathNode& left() const { return left_; }
  /// Whether M is constant, and C, too, unless every coordinate has mass.
  bool has_constant_leading_matrix() const;

 private:
  std::shared_ptr<const Sample> sample(double t) const;
  /// Width of the bands of the pencils at both ends; empty where they are not banded.
  std::optional<Eigen::Index> find_width() const;
  Matrix interpolate(const MatrixSeries& left, const MatrixSeries& right, const Vector& weights) const;
  /// The series G(h) = (D^T T(h))^-1, where D is dual to the columns of a basis at the left point and T its
  /// series at the right one: T(h) G(h) spans the same space as T(h), in the coordinates of the left point.
  MatrixSeries change_of(const Matrix& dual, const MatrixSeries& right) const;
  /// Replaces the series B of the right pencil by E^T B G, by products that use BLAS or leave zeros out.
  void turn(const MatrixSeries& equations, const MatrixSeries& coordinates);

  const PathNode& left_;
  const ReducedPencil& left_pencil_;
  double length_;
  Eigen::Index count_;  ///< number of coefficients at each end
  int part_;
  ReducedPencil right_;  ///< the right pencil in the reduced coordinates of the left point
  mutable std::mutex mutex_;
  /// Samples by t. The certificates of all tracks of a step use the same values of t.
  mutable std::map<double, std::shared_ptr<const Sample>> samples_;
  mutable std::optional<std::shared_ptr<const EnergyNorm>> energy_norm_;
  /// What find_width found, once it was asked for.
  mutable std::optional<std::optional<Eigen::Index>> width_;
};

/// Whether the test closes on the whole step from `left` to `right`, which are the same track at both ends.
/// `gap` is the distance to the nearest other known eigenvalue. It scales Lambda against Z in the norm of the
/// unknowns (vec Z, vec Lambda / scale), scale = gap / 2 within limits. Factorizations are added to `counts`.
/// `gave_up`, if given, is set to whether the test was not carried to its end because it takes too much work.
bool certify_step(const StepPencil& pencil, const Track& left, const Track& right, double gap,
                  RunCounts& counts, bool* gave_up = nullptr);

}  // namespace eigentrail
