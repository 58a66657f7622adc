// Large sparse families for tests and benchmarks: a plate and a solid shaft with discs, both in a frame that
// rotates with the traced parameter, the scene's parameter 0.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "eigentrail/projection/project.hpp"

namespace eigentrail::test {

/// Two displacement fields on a grid of `cells` x `cells` places (finite differences), of varying mass,
/// coupled by Coriolis terms; the rotation stiffens one and softens the other. n = 2 cells^2; the lowest
/// frequencies are 4 to 8 rad/s, and meet each other between 0 and 6 rad/s.
struct RotatingPlate {
  int cells = 16;
  double damping = 0.02;     ///< C = damping M
  double circulatory = 0.0;  ///< factor of a skew-symmetric stiffness
  /// Times the rotation: factor of a first derivative (a medium that flows through the first field), which
  /// turns left vectors away from right ones.
  double convection = 0.0;
};
AffinePencil<SparseMatrix> rotating_plate(const RotatingPlate& plate);

/// A shaft of steel from elements of eight nodes, square in section or flattened, with discs, in two
/// isotropic bearings, seen from the rotating frame: gyroscopic terms, centrifugal softening, internal
/// damping (in proportion to the stiffness) and external damping in the bearings, which is circulatory in
/// this frame. SI units.
struct SolidShaft {
  double cell = 0.02;  ///< edge of an element, m
  int length = 40;     ///< elements along the axis
  int width = 2;       ///< elements of the section's sides
  int disc_width = 8;  ///< the same for discs; even if `width` is even, else odd
  /// Height of the section and of the discs over their width. With less than 1 the shaft bends more easily in
  /// one direction, as the rotor of a generator with two poles does: frequencies part at rest and near it,
  /// and veer later on where those of a round shaft cross.
  double flatness = 1.0;
  std::vector<int> discs{10, 26};  ///< first layers of the discs; each is two layers thick
  double bearing_stiffness = 2e8, bearing_damping = 2e4;  ///< N/m, N s/m
  double internal_damping = 2e-6;                         ///< s, times the stiffness
};
AffinePencil<SparseMatrix> solid_shaft(const SolidShaft& shaft);

/// A trace of a sparse family over its parameter "omega" (rad/s), ready for `project` and `trace`.
TraceSetup large_setup(AffinePencil<SparseMatrix> pencil, double from, double to, int modes,
                       double tolerance);

/// The model of such a trace without ownership, as `project` takes it.
std::shared_ptr<const Model> shared_model(const TraceSetup& setup);

/// The projection of its model, which stays as it is.
std::unique_ptr<ProjectedFamily> projected_family(const TraceSetup& setup, const TraceOptions& trace,
                                                  const ProjectionOptions& options = {});

/// Eigenvalues s (Im s >= 0) of the pencil nearest to `near`, by shift-invert iteration of a block of vectors
/// with Eigen's sparse LU: independent of the library's solvers.
std::vector<Complex> eigenvalues_near(const AffinePencil<SparseMatrix>& at, Complex near, int count);

}  // namespace eigentrail::test
