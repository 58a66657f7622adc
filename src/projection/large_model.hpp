// What the projection asks of a large model: a sparse family, or a scene of bodies with constraints.
#pragma once

#include "eigentrail/continuation/trace_result.hpp"
#include "eigentrail/projection/project.hpp"
#include "projection/projection_error.hpp"
#include "projection/projection_space.hpp"

namespace eigentrail {

/// A place on the path of a large model.
struct LargePlace {
  double p = 0.0;     ///< traced parameter
  Vector parameters;  ///< all of them, declared units
  Vector x, lambda;   ///< the equilibrium of a scene; empty for a family
};

/// A place on the path of a projected model, with its followed modes in projected coordinates.
struct ProjectedPlace {
  LargePlace at;
  SmallPencil small;
  std::vector<ProjectedMode> modes;
  bool is_old = false;  ///< `small` and `modes` are of a space that has changed
};

/// Bases of right and of left vectors, n x k; mostly one for both.
struct Bases {
  std::shared_ptr<const Matrix> right, left;
};

/// Throws InputError, for a model that is so large that only some of its modes can be followed.
[[noreturn]] void refuse_all_modes(const Model& model);

class LargeModel {
 public:
  LargeModel() = default;
  virtual ~LargeModel() = default;
  LargeModel(const LargeModel&) = delete;
  LargeModel& operator=(const LargeModel&) = delete;

  virtual const Model& model() const = 0;

  /// The place of the path at these parameters, followed from the last one. Empty if the path does not reach
  /// it. Throws NotProjected if there is no equilibrium to begin with.
  virtual std::optional<LargePlace> place_at(double p, const Vector& parameters) = 0;

  /// The place at the parameters of `guess`, with the equilibrium that its x and lambda lead to. Empty if
  /// there is none.
  virtual std::optional<LargePlace> place_near(const LargePlace& guess) = 0;

  virtual SparsePencil pencil(const LargePlace& place) const = 0;

  /// Vectors as they are added to the space.
  virtual ComplexMatrix for_space(const ComplexMatrix& vectors) const = 0;

  /// The model on the part of the space that the vectors need up to the relative error `accuracy` in the norm
  /// of the energy K + frequency^2 M; the space becomes this part, and gives it away.
  virtual std::unique_ptr<Model> reduced(ProjectionSpace& space, double accuracy, const Vector& middle,
                                         double frequency) const = 0;
  /// A smaller model on two spaces, of right and of left vectors, from one that `reduced` gave, whose space
  /// has both; arguments as there. Null where little is gained.
  virtual std::unique_ptr<Model> on_two_spaces(const Model& reduced, const ProjectionSpace& space,
                                               double accuracy, const Vector& middle,
                                               double frequency) const = 0;

  /// The projected matrices at a traced point, and the reduced coordinates of one of its shapes.
  virtual SmallPencil small(const Model& reduced, const TracePoint& point) const = 0;
  /// The same at a place with its pencil and the basis of its motions.
  virtual SmallPencil small(const Model& reduced, const LargePlace& place, const SparsePencil& pencil,
                            const Matrix& basis) const = 0;
  virtual ComplexVector coordinates(const TracePoint& point, const ComplexVector& shape) const = 0;

  /// Bases of the motions of the reduced model at the place of a pencil; they live as long as `reduced` and
  /// the result do. Empty if the motions have turned too far.
  virtual std::optional<Bases> bases(const Model& reduced, const SparsePencil& pencil) const = 0;
};

/// All parameters (declared units) where those of a line have its values and the traced one is p.
Vector parameters_at(const Model& model, const TraceOptions& trace, const ParameterValues& line, double p);

/// The shift for a choice of modes: the middle of those that are wanted, or zero.
Shift usual_shift(const ModeChoice& choice);

/// A sparse family or a scene of bodies as a large model.
std::unique_ptr<LargeModel> large_model_of(std::shared_ptr<const Model> model, const TraceOptions& trace);
/// The same for a scene.
std::unique_ptr<LargeModel> large_scene_of(std::shared_ptr<const Model> scene, const TraceOptions& trace);

}  // namespace eigentrail
