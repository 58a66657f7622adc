// One point of the path, in five calls: solve the equilibrium, linearize, reduce, correct the modes,
// differentiate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/prediction.hpp"

namespace eigentrail {

/// The problem of following `model` along the parameter of that name, all others at their declared values.
/// Throws std::bad_optional_access when the model has no such parameter.
PathProblem problem_along(const Model& model, const std::string& parameter);

/// Parameters at p, in declared units.
Vector parameters_at(const PathProblem& problem, double p);

/// Equilibrium, linearization and reduction at p; no modes yet.
PathPoint reduce_at(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                    const Matrix& previous_basis, RunCounts& counts,
                    const std::optional<PathPlane>& plane = std::nullopt);

/// The same on a path whose series is known at the point.
PathPoint reduce_on(const PathProblem& problem, const Path& known, const Matrix& previous_basis,
                    RunCounts& counts);

/// Series of the equilibrium at a point along the traced parameter, or along the path's own coordinate when
/// the point lies on a plane.
EvaluationFault equilibrium_series(const PathProblem& problem, const PathPoint& point, int order, Path& path,
                                   RunCounts& counts);

/// The whole point, from a prediction.
PathPoint compute_point(const PathProblem& problem, const Prediction& prediction,
                        const Matrix& previous_basis, RunCounts& counts);

/// Differentiates a computed point to one order more than the problem's, along the traced parameter, or along
/// the path's own coordinate when the point lies on a plane. Empty when a series coefficient is not finite.
/// The tracks have their roots, but no modes assigned yet.
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            RunCounts& counts);

/// The same along another parameter, all others held: the sensitivities of the equilibrium and of the modes
/// to it. The factorizations of the point are reused, so each further parameter costs back-substitutions only
/// (seed paper, end of Sect. 4.3).
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point, int parameter,
                                            RunCounts& counts);

/// The same along any curve in parameter space: `parameters` (n_parameters x (<= order + 2)) is the series of
/// all parameters, column 0 their values at the point. Parameters that are defined by others follow from
/// them, whatever their rows hold.
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            const VectorSeries& parameters, RunCounts& counts);

}  // namespace eigentrail
