#include <algorithm>
#include <cmath>

#include "accuracy/verify/comparisons.hpp"
#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// Whether vectors are the same: each component up to a share of its usual magnitude, `sizes`, and up to a
/// smaller share of the largest one, to which the others are known.
template <class Vectors>
bool is_same_vector(const Vectors& a, const Vectors& b, const Vector& sizes) {
  constexpr double share = 1e-5, share_of_largest = 1e-8;
  const double largest = sizes.size() > 0 ? sizes.maxCoeff() : 0.0;
  return ((a - b).cwiseAbs().array() <= share * sizes.array() + share_of_largest * largest).all();
}

/// A step of inverse iteration, P(sigma) next = (sigma - s) ((s + sigma) M + C) shape, of which a shape of
/// the eigenvalue s stays as it is, also of a multiple one. The shift is larger than the error of s.
ComplexVector iterated(const PathPoint& point, Complex s, double shift, const ComplexVector& shape) {
  const Matrix& M = point.pencil.M[0];
  const Matrix& C = point.pencil.C[0];
  const Complex sigma = s + shift;
  ComplexVector z = point.basis.coordinates(shape, 0);
  z = shift * (((s + sigma) * M + C) * z).eval();
  ComplexLu(ComplexMatrix(sigma * sigma * M + sigma * C + point.pencil.K[0])).solve_in_place(z);
  return point.basis.shapes(z, 0);
}

/// Largest magnitude of eigenvalues that a step of inverse iteration cannot tell from zero to its accuracy: K
/// of a rigid-body motion is rounding, which has to be small against the square of the shift.
double hidden_size(const ReducedPencil& pencil) {
  constexpr double share = 1e-5;  // its square is far above rounding
  const double mass = pencil.M[0].norm(), damping = pencil.C[0].norm(), stiffness = pencil.K[0].norm();
  if (mass > 0.0) return share * std::sqrt(stiffness / mass);
  return damping > 0.0 ? share * share * stiffness / damping : 0.0;
}

/// Whether a mode shape has unit length and is one of the eigenvalue s.
bool is_shape(const CheckedFile& file, const PathPoint& point, Complex s, const ComplexVector& shape,
              const Vector& sizes) {
  constexpr double least_shift = 1e-5, rounding = 1e-8, least_share = 0.3;
  const double mass = mass_norm_squared(shape, point.equilibrium.linearization.M[0]);
  if (!(std::abs((mass > 0.0 ? mass : shape.squaredNorm()) - 1.0) <= rounding)) return false;
  const double hidden = hidden_size(point.pencil);
  const double shift = std::max(std::max(least_shift, 10.0 * file.accuracy.tolerance) * file.scale_of(s),
                                std::abs(s) < hidden ? hidden : 0.0);
  const ComplexVector next = iterated(point, s, shift, shape);
  if (!next.allFinite()) return true;  // the pencil is singular beside s: it is known that well
  const Complex share = shape.dot(next) / shape.squaredNorm();
  return std::abs(share) >= least_share && is_same_vector(shape, ComplexVector(next / share), sizes);
}

}  // namespace

Comparison compare_points(const CheckedFile& file, const VerifyOptions& options, const FreshSolver& solver) {
  const LociFile& loci = file.loci;
  Comparison result;
  const Vector sizes = loci.equilibrium.cwiseAbs().colwise().maxCoeff().transpose();
  const std::vector<std::size_t> nodes = file.plain_nodes(samples_of(options, solver));
  std::size_t n_shapes = 0;
  read_mode_shapes(loci, [&](std::size_t node, std::span<const Complex> values) {
    if (!std::binary_search(nodes.begin(), nodes.end(), node)) return;
    const double p = loci.p[node];
    const auto row = static_cast<Eigen::Index>(node);
    const PathPoint point = solver.point_at(file.loci.at_node(node));
    const bool solved = point.status == PointStatus::computed;
    if (!solved ||
        !is_same_vector(Vector(loci.equilibrium.row(row).transpose()), point.equilibrium.x, sizes)) {
      result.faults.push_back("the stored equilibrium at " + file.at(p) + " is none");
      return;
    }
    const ComplexMatrix shapes = ComplexMatrix::Map(values.data(), loci.equilibrium.cols(),
                                                    static_cast<Eigen::Index>(loci.modes.size()));
    const Vector shape_sizes = shapes.array().isFinite().select(shapes.cwiseAbs(), 0.0).rowwise().maxCoeff();
    for (Eigen::Index mode = 0; mode < shapes.cols(); ++mode) {
      const Complex s = loci.eigenvalues(row, mode);
      if (!std::isfinite(std::abs(s))) continue;
      ++n_shapes;
      if (!is_shape(file, point, s, shapes.col(mode), shape_sizes))
        result.faults.push_back("mode_shape of " + file.mode_at(mode, p) + " is none of its eigenvalue");
    }
  });
  result.compared = "equilibria of " + count_of(nodes.size(), "stored point") + " and " +
                    count_of(n_shapes, "mode shape") + " against their equations";
  return result;
}

}  // namespace eigentrail
