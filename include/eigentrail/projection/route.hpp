// The way that a model takes through a trace: by the dense engine with all its freedoms, or projected onto
// the space of its followed modes. The choice compares counted operations and not times, so that a model
// takes the same way on every machine.
#pragma once

#include <optional>
#include <string>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/core/sparse_solver.hpp"
#include "eigentrail/model/affine_family.hpp"

namespace eigentrail {

/// What a projection will need, from the symbolic analysis of the pencil in the middle of the range.
struct ProjectionEstimate {
  Eigen::Index freedoms = 0;
  Eigen::Index coordinates = 0;    ///< of a scene; 0: a family
  Eigen::Index nonzeros = 0;       ///< of M, C, K and A together
  bool moves = false;              ///< the equilibrium is followed: a factorization per point of the trace
  bool two_sided = false;          ///< left vectors are needed
  std::string method;              ///< of the factorization
  double factor_bytes = 0.0;       ///< of one factorization; one is kept at a time
  double factor_operations = 0.0;  ///< of one factorization
  double total_bytes = 0.0;        ///< with matrices, Arnoldi vectors and the space
  double target = 0.0;             ///< error of the projection, relative to the eigenvalues
};

/// The estimate for a sparse family, or for a scene of bodies at its starting guess. Throws NotProjected
/// where the scene's equations have no finite values, and std::bad_variant_access for dense matrices.
ProjectionEstimate estimate_projection(const Model& model, const TraceOptions& trace,
                                       const SparseSolverMaker& solver = {});

/// Operations of a trace, as `route_work` counts them: multiplications of real numbers, weighted by their
/// time relative to those of back-substitutions.
struct TraceWork {
  double dense = 0.0;      ///< by the dense engine, with all freedoms
  double projected = 0.0;  ///< with the samples of the projection and the rough traces for it
};

/// A trace with the number of points that such models have; ratios depend little on it. `estimate`: of the
/// model.
TraceWork trace_work(const ProjectionEstimate& estimate, const TraceOptions& trace);

/// The dense engine knows all modes of a model, the projection only some of them. So the projection is taken
/// only where it needs fewer operations by this factor.
inline constexpr double worth_projecting = 1.25;

struct Route {
  bool is_projected = false;
  /// What was compared; empty where there was no choice.
  std::optional<TraceWork> work = {};
};

/// The way of a trace of `model`. Families of dense matrices, models with trim conditions, and traces of all
/// modes stay with the dense engine. Throws InputError if that cannot hold the model (limits::matrix_rows).
Route route_of(const Model& model, const TraceOptions& trace);

/// Whether the model is to be projected.
inline bool is_large(const Model& model, const TraceOptions& trace) {
  return route_of(model, trace).is_projected;
}

/// The model as a sparse family that is to be projected; null if it is none, or is not to be projected.
const SparseFamily* large_family(const Model& model, const TraceOptions& trace);

}  // namespace eigentrail
