#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "accuracy/verify/comparisons.hpp"
#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/modes/normalization.hpp"

namespace eigentrail {
namespace {

/// Largest difference of a component from the one computed afresh, relative to the largest one that it has.
constexpr double largest_difference = 1e-5;
/// Likewise relative to the largest of all components: the others are known to that.
constexpr double rounding_of_vector = 1e-8;

/// Whether `found` is `stored` but for rounding; `sizes` has the largest magnitude of each component.
double vector_difference(const ComplexVector& stored, const ComplexVector& found, const Vector& sizes) {
  const Vector allowed = largest_difference * sizes.array() + rounding_of_vector * sizes.maxCoeff() + 1e-300;
  return ((stored - found).cwiseAbs().cwiseQuotient(allowed)).maxCoeff();
}

/// P(s) = s^2 M + s C + K of the reduced pencil.
ComplexMatrix pencil_at(const ReducedPencil& pencil, Complex s) {
  return s * s * pencil.M[0] + s * pencil.C[0] + pencil.K[0];
}

/// The shape after a step of inverse iteration, of the length and phase of the given one. A shape of the
/// eigenvalue s, also of a multiple one, stays as it is.
ComplexVector iterated(const PathPoint& point, Complex s, const ComplexVector& shape, double scale) {
  constexpr double shift = 1e-7;
  ComplexVector z = point.basis.coordinates(shape, 0);
  z = (2.0 * s * point.pencil.M[0] + point.pencil.C[0]) * z;
  ComplexLu(pencil_at(point.pencil, s + shift * scale)).solve_in_place(z);
  const ComplexVector v = point.basis.shapes(z, 0);
  return v * (v.dot(shape) / v.squaredNorm());
}

}  // namespace

Comparison compare_points(const CheckedFile& file, const VerifyOptions& options, const FreshSolver& solver) {
  const LociFile& loci = file.loci;
  Comparison result;
  const Vector sizes = loci.equilibrium.cwiseAbs().colwise().maxCoeff().transpose();
  const std::vector<std::size_t> nodes = file.plain_nodes(samples_of(options, solver));
  std::size_t shapes_compared = 0;
  read_mode_shapes(loci, [&](std::size_t node, std::span<const Complex> row) {
    if (!std::binary_search(nodes.begin(), nodes.end(), node)) return;
    const double p = loci.p[node];
    const PathPoint point = solver.point_at(file.node(node));
    if (point.status != PointStatus::computed) {
      result.faults.push_back("no equilibrium near the stored one at " + file.at(p));
      return;
    }
    const auto i = static_cast<Eigen::Index>(node);
    if (sizes.size() > 0) {
      const double d = vector_difference(loci.equilibrium.row(i).transpose().cast<Complex>(), point.equilibrium.x.cast<Complex>(), sizes);
      if (getenv("VDEBUG")) fprintf(stderr, "EQ %g\n", d);
      if (d > 1) result.faults.push_back("the stored equilibrium at " + file.at(p) + " is none");
    }
    const auto n = static_cast<Eigen::Index>(loci.coordinates.size());
    const ComplexMatrix shapes = ComplexMatrix::Map(row.data(), n, static_cast<Eigen::Index>(loci.modes.size()));
    const Vector shape_sizes = shapes.cwiseAbs().rowwise().maxCoeff();
    for (Eigen::Index mode = 0; mode < shapes.cols(); ++mode) {
      const Complex s = loci.eigenvalues(i, mode);
      if (!std::isfinite(std::abs(s))) continue;
      ++shapes_compared;
      const ComplexVector v = shapes.col(mode);
      const ComplexVector z = point.basis.coordinates(v, 0);
      const double size = std::abs(s);
      const ComplexVector r = pencil_at(point.pencil, s) * z;
      const Vector mag = (size * size * point.pencil.M[0].cwiseAbs() + size * point.pencil.C[0].cwiseAbs() + point.pencil.K[0].cwiseAbs()) * z.cwiseAbs();
      const double roww = (r.cwiseAbs().array() / (mag.array() + 1e-300)).maxCoeff();
      const double d = vector_difference(v, iterated(point, s, v, file.scale_of(s)), Vector(v.cwiseAbs().cwiseMax(shape_sizes)));
      const double nrm = mass_norm_squared(v, point.equilibrium.linearization.M[0]);
      if (getenv("VDEBUG")) fprintf(stderr, "SH %s row %g iter %g norm %g\n", file.mode_at(mode,p).c_str(), roww, d*largest_difference, nrm - 1);
      if (d > 1) result.faults.push_back("mode_shape of " + file.mode_at(mode, p) + " is none of its eigenvalue");
    }
  });
  result.compared = count_text(nodes.size(), "equilibrium") + count_text(shapes_compared, "mode shape");
  return result;
}

}  // namespace eigentrail
