#include <algorithm>
#include <cmath>

#include "core/products.hpp"
#include "core/sparse_constraints.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/steady/equilibrium.hpp"
#include "projection/family_pencils.hpp"
#include "projection/large_model.hpp"

namespace eigentrail {
namespace {

/// Order of the series by which an equilibrium is predicted, and the size of its last term, relative to the
/// position, that sets the step.
constexpr int order = 4;
constexpr double last_term = 1e-4;
/// Shortest step, as a share of what is left of the way.
constexpr double shortest_stride = 1e-4;
/// Iterations from a predicted guess; more show that the step is too long.
constexpr int few_iterations = 12;

/// A scene of bodies with constraints. Its vectors are kept by their parts that are allowed at the first
/// place, the reference (restricted_basis).
class LargeScene final : public LargeModel {
 public:
  LargeScene(std::shared_ptr<const Model> scene, const TraceOptions& trace)
      : scene_(std::move(scene)),
        structure_(scene_->structure(scene_->description().parameters.index(trace.parameter).value())),
        counts_(scene_->new_counts()) {}

  const Model& model() const override { return *scene_; }

  std::optional<LargePlace> place_at(double p, const Vector& parameters) override {
    if (last_.x.size() == 0) {
      begin(p, parameters);
      return last_;
    }
    const double from = last_.p;
    double way = 1.0;  // what is left of it
    for (double stride = 1.0; way > 0.0;) {
      VectorSeries ahead(parameters.size(), 2);
      ahead << last_.parameters, parameters - last_.parameters;
      Path path;
      if (differentiate_equilibrium(*scene_, at_, ahead, order, path, counts_)) return std::nullopt;
      const double bend = path.x.col(order).norm() / (last_term * path.x.col(0).norm());
      for (stride = std::min(1.0, bend > 0.0 ? std::pow(bend, -1.0 / order) : 1.0);; stride *= 0.5) {
        if (stride < shortest_stride) return std::nullopt;
        const Vector there = stride == 1.0 ? parameters : Vector(ahead.col(0) + stride * ahead.col(1));
        Equilibrium next = solve(there, evaluate_series(path.x, stride), evaluate_series(path.lambda, stride),
                                 few_iterations, false);
        if (next.status != SteadyStatus::converged) continue;
        at_ = std::move(next);
        way = stride == 1.0 ? 0.0 : way * (1.0 - stride);
        last_ = {p - way * (p - from), there, at_.x, at_.lambda};
        break;
      }
    }
    return last_;
  }

  std::optional<LargePlace> place_near(const LargePlace& guess) override {
    const Equilibrium there =
        solve(guess.parameters, guess.x, guess.lambda, SteadyOptions().max_iterations, false);
    if (there.status != SteadyStatus::converged) return std::nullopt;
    return LargePlace{guess.p, guess.parameters, there.x, there.lambda};
  }

  SparsePencil pencil(const LargePlace& place) const override {
    Linearization at;
    EvaluationCounts counts = scene_->new_counts();
    if (scene_->linearize({place.parameters, place.x, place.lambda}, 0, at, counts))
      throw NotProjected("a number that is not finite comes out of the large model");
    SparsePencil pencil{at.M[0].sparse(), at.C[0].sparse(), at.K[0].sparse()};
    const bool conservative = structure_.symmetric_mass && !structure_.circulatory;
    pencil.symmetric = conservative && !structure_.gyroscopic;
    pencil.one_sided = conservative && !(structure_.gyroscopic && structure_.damped);
    if (scene_->n_constraints() == 0) return pencil;
    if (!SparseConstraints::factor(at.A[0].sparse()))
      throw NotProjected(
          "some constraints of the large model depend on others, or nearly so. Large models need independent "
          "ones: leave out a joint that others imply");
    pencil.A = at.A[0].sparse();
    pencil.constraints = std::make_shared<const ConstraintFactorization>(at.A[0]);
    return pencil;
  }

  ComplexMatrix for_space(const ComplexMatrix& vectors) const override { return reference_.allowed(vectors); }

  std::unique_ptr<Model> reduced(ProjectionSpace& space, double accuracy, const Vector&,
                                 double frequency) const override {
    const Matrix& Q = space.basis();
    const Matrix sum = transposed_product(Q, Matrix(reference_.K * Q)) +
                       frequency * frequency * transposed_product(Q, Matrix(reference_.M * Q));
    space.reduce(0.5 * (sum + sum.transpose()), accuracy);
    Projection projection;
    projection.freedoms = scene_->n_coordinates() - scene_->n_constraints();
    projection.names = scene_->description().coordinate_names;
    projection.motions = Motions{space.give_basis(), reference_.A};
    return std::make_unique<ProjectedScene>(scene_, std::move(projection),
                                            Path{first_.parameters, first_.x, first_.lambda});
  }
  /// Null: the motions of a scene are those of both.
  std::unique_ptr<Model> on_two_spaces(const Model&, const ProjectionSpace&, double, const Vector&,
                                       double) const override {
    return nullptr;
  }

  SmallPencil small(const Model&, const TracePoint& point) const override {
    const ReducedPencil& pencil = point.node.pencil;
    return {pencil.M[0], pencil.C[0], pencil.K[0]};
  }
  SmallPencil small(const Model&, const LargePlace&, const SparsePencil& pencil,
                    const Matrix& basis) const override {
    return {projected(pencil.M, basis), projected(pencil.C, basis), projected(pencil.K, basis)};
  }
  ComplexVector coordinates(const TracePoint& point, const ComplexVector& shape) const override {
    return point.node.basis.T[0].transpose() * shape;
  }

  std::optional<Bases> bases(const Model& reduced, const SparsePencil& pencil) const override {
    const SystemMatrix A(pencil.A);
    const ConstraintFactorization none;
    auto at =
        restricted_basis(*reduced.projection()->motions, A, pencil.constraints ? *pencil.constraints : none);
    if (!at) return std::nullopt;
    const auto basis = std::make_shared<const Matrix>(std::move(at->T[0]));
    return Bases{basis, basis};
  }

 private:
  Equilibrium solve(const Vector& parameters, const Vector& x, const Vector& lambda, int most_iterations,
                    bool relax) {
    SteadyOptions options;
    options.relax = relax;
    options.max_iterations = most_iterations;
    return solve_equilibrium(*scene_, parameters, x, lambda, options, counts_);
  }

  void begin(double p, const Vector& parameters) {
    const Vector guess = scene_->initial_guess(parameters);
    (void)pencil({p, parameters, guess, Vector::Zero(scene_->n_constraints())});  // throws early
    at_ = solve(parameters, guess, Vector(), SteadyOptions().max_iterations, true);
    if (at_.status != SteadyStatus::converged) throw NotProjected(at_.report.message);
    first_ = last_ = {p, parameters, at_.x, at_.lambda};
    reference_ = pencil(first_);
  }

  std::shared_ptr<const Model> scene_;
  Structure structure_;
  EvaluationCounts counts_;
  LargePlace first_, last_;
  Equilibrium at_;          ///< at the last place
  SparsePencil reference_;  ///< at the first place
};

}  // namespace

std::unique_ptr<LargeModel> large_scene_of(std::shared_ptr<const Model> scene, const TraceOptions& trace) {
  return std::make_unique<LargeScene>(std::move(scene), trace);
}

}  // namespace eigentrail
