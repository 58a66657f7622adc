// Computation of one point of the path in five stages: solve for the equilibrium, linearize, reduce to the
// tangent space of the constraints, correct the modes, differentiate.
#pragma once

#include <optional>
#include <string>

#include "eigentrail/continuation/point_modes.hpp"

namespace eigentrail {

/// The problem of following `model` along the parameter of that name, all others at their declared values.
/// Throws std::bad_optional_access when the model has no such parameter.
PathProblem problem_along(const Model& model, const std::string& parameter);

/// All parameters with the traced one at p, in declared units.
Vector parameters_at(const PathProblem& problem, double p);

/// Equilibrium, linearization and reduction at p; no modes yet. `guess` is the initial guess of Newton's
/// method. `previous_basis` is the tangent basis (n x (n - rank A)) of a nearby point, to which the new one
/// is aligned; it may be empty. With a `plane`, p is an unknown and the given value its initial guess.
/// Failures are reported in the point's status.
PathPoint reduce_at(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                    const Matrix& previous_basis, RunCounts& counts,
                    const std::optional<PathPlane>& plane = std::nullopt);

/// The same where the series of the equilibrium is known at the point, as on a bridge over a branch point.
PathPoint reduce_on(const PathProblem& problem, const Path& known, const Matrix& previous_basis,
                    RunCounts& counts);

/// Series of the equilibrium at a point up to `order`, in powers of the traced parameter, or of the distance
/// across the plane if the point lies on one. Returns the fault of an evaluation, if there was one.
EvaluationFault equilibrium_series(const PathProblem& problem, const PathPoint& point, int order, Path& path,
                                   RunCounts& counts);

/// Equilibrium, reduction and corrected modes of a point, from a prediction. Failures are reported in the
/// point's status.
PathPoint compute_point(const PathProblem& problem, const Prediction& prediction,
                        const Matrix& previous_basis, RunCounts& counts);

/// Series of everything at a computed point, to one order more than the problem's, in powers of the traced
/// parameter, or of the distance across the plane if the point lies on one. Empty if a series coefficient is
/// not finite. The tracks have roots, but no mode numbers yet.
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            RunCounts& counts);

/// The same in powers of another parameter, all others constant: the sensitivities of the equilibrium and of
/// the modes to it. The factorizations of the point are reused, so each further parameter costs only
/// back-substitutions (seed paper, end of Sect. 4.3). Throws std::invalid_argument for a parameter that is
/// defined by others.
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point, int parameter,
                                            RunCounts& counts);

/// The same along any curve in parameter space: `parameters` (n_parameters x (<= order + 2)) is the series of
/// all parameters, column 0 their values at the point. Rows of parameters that are defined by others are
/// ignored; these follow from their definitions.
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            const VectorSeries& parameters, RunCounts& counts);

}  // namespace eigentrail
