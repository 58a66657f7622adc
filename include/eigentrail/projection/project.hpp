// Large models: a sparse family is projected onto the space of its followed modes' vectors at few values of
// the parameter. The projected family is a model like others, which the engine traces as it is.
//
// Each value costs one sparse factorization (shift-invert Arnoldi, right and left vectors). A trace of the
// projected family follows the modes; residuals of the large pencil along it, right and left ones, show where
// the projection is worst, and there the next value is taken, until its exact eigenvalues agree with those of
// the projection. With both vectors in the space the error of an eigenvalue is of second order in the
// distance of the vectors from the space.
#pragma once

#include <memory>
#include <stdexcept>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/core/sparse_solver.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "eigentrail/model/projection.hpp"

namespace eigentrail {

/// Thrown if a large model cannot be projected; the message says why and what to do.
class NotProjected : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ProjectionOptions {
  /// Largest error of an eigenvalue by the projection, relative to max(|s|, reference), as a share of the
  /// tolerance of the trace: what is left is for the trace itself, and places of events follow from it.
  double share_of_tolerance = 0.01;
  int first_samples = 2;        ///< values of the parameter before the first trace, ends included; >= 2
  int max_factorizations = 40;  ///< the projection ends there and says what error is left
  int spare_modes = 3;          ///< modes beyond the followed ones whose vectors are kept as well; >= 0
  /// Whether left vectors are kept where the pencil is not symmetric. Without them the error of an eigenvalue
  /// is of first order; only for comparisons.
  bool left_vectors = true;
  SparseSolverMaker solver = {};  ///< what factors the large pencil; empty: SuiteSparse
};

/// The part of a projected model that knows of the projection.
class Projected {
 public:
  /// Replaces all that is known of the projection, but for its space.
  void settle(Projection outcome);
  /// Moves the basis of the space out of a model that is no longer needed.
  Matrix take_basis();

 protected:
  explicit Projected(Projection projection) : projection_(std::move(projection)) {}

  Projection projection_;
};

/// A family that was projected.
class ProjectedFamily final : public AffineFamily<Matrix>, public Projected {
 public:
  ProjectedFamily(ModelDescription description, AffinePencil<Matrix> pencil, Projection projection);

  const Projection* projection() const override { return &projection_; }
};

/// A scene whose linearized equations are restricted to few motions. Its equilibrium is that of the whole
/// scene.
class ProjectedScene final : public Model, public Projected {
 public:
  /// `first`: an equilibrium that is known, with the parameters that belong to it.
  ProjectedScene(std::shared_ptr<const Model> scene, Projection projection, Path first);

  const Projection* projection() const override { return &projection_; }

  Vector initial_guess(const Vector& parameters) const override;
  Structure structure(int traced_parameter) const override { return scene_->structure(traced_parameter); }
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override {
    return scene_->residual(path, order, result, counts);
  }
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override {
    return scene_->linearize(path, order, result, counts);
  }
  std::vector<Expression> expressions() const override { return scene_->expressions(); }
  std::vector<double> kinks(int traced_parameter) const override { return scene_->kinks(traced_parameter); }
  EvaluationFault extended_residual(const BasicPath<Extended>& path,
                                    BasicSteadyResidual<Extended>& result) const override {
    return scene_->extended_residual(path, result);
  }
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override {
    return scene_->extended_linearization(path, result);
  }

 private:
  std::shared_ptr<const Model> scene_;
  Path first_;
};

/// Values of parameters that replace the declared ones, in their units.
using ParameterValues = std::map<std::string, double>;

/// Lines evenly over a range of a second parameter; what lies between two of them is as close to the space as
/// they are, where the modes change smoothly.
std::vector<ParameterValues> lines_over(const TraceOptions& trace, const std::string& second, double from,
                                        double to);

/// Projects a sparse family or a scene of bodies with sparse matrices for traces with the options `trace`,
/// along each of the lines; without lines, along the one that `trace.values` gives. The path of a scene is
/// followed with the whole equilibrium, one sparse factorization of the steady equations per point. Throws
/// InputError if the options ask for all modes, and NotProjected if modes cannot be found, or if a scene has
/// no equilibrium or redundant constraints. A family becomes a ProjectedFamily.
std::unique_ptr<Model> project(std::shared_ptr<const Model> model, const TraceOptions& trace,
                               const std::vector<ParameterValues>& lines = {},
                               const ProjectionOptions& options = {});

/// Projects a model for single values of the traced parameter: the chosen modes are exact at each of them.
/// One factorization for each value. Throws as `project`.
std::unique_ptr<Model> project_at(std::shared_ptr<const Model> model, const TraceOptions& trace,
                                  const std::vector<double>& values, const ProjectionOptions& options = {});

/// Replaces a large model by its projection; leaves others as they are.
void project_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                      const std::vector<ParameterValues>& lines = {}, const ProjectionOptions& options = {});
/// The same for single values of the traced parameter: as project_at.
void project_at_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                         const std::vector<double>& values, const ProjectionOptions& options = {});

}  // namespace eigentrail
