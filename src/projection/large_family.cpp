#include "core/products.hpp"
#include "projection/family_pencils.hpp"
#include "projection/large_model.hpp"

namespace eigentrail {
namespace {

/// A family of sparse matrices at rest: its projection is a family of the same factors.
class LargeFamily final : public LargeModel {
 public:
  explicit LargeFamily(std::shared_ptr<const SparseFamily> family)
      : family_(std::move(family)), pencils_(*family_) {}

  const Model& model() const override { return *family_; }

  std::optional<LargePlace> place_at(double p, const Vector& parameters) override {
    return LargePlace{p, parameters, {}, {}};
  }
  std::optional<LargePlace> place_near(const LargePlace& guess) override { return guess; }
  SparsePencil pencil(const LargePlace& place) const override { return pencils_.at(place.parameters); }
  ComplexMatrix for_space(const ComplexMatrix& vectors) const override { return vectors; }

  std::unique_ptr<Model> reduced(ProjectionSpace& space, double accuracy, const Vector& middle,
                                 double frequency) const override {
    const SparsePencil there = pencils_.at(middle);
    const Matrix energy = projected(there.K + frequency * frequency * there.M, space.basis());
    space.reduce(0.5 * (energy + energy.transpose()), accuracy);
    Matrix basis = space.give_basis();
    AffinePencil<Matrix> pencil = pencils_.projected(basis);
    return model_of(std::move(pencil), std::move(basis), {});
  }
  std::unique_ptr<Model> on_two_spaces(const Model& reduced, const ProjectionSpace& space, double accuracy,
                                       const Vector& middle, double frequency) const override {
    constexpr double much = 0.9;  // of the coordinates: what is left of them is worth the work
    const SmallPencil there = small_at(reduced, middle);
    const TwoSpaces spaces = two_spaces(space, there.K + frequency * frequency * there.M, accuracy);
    const Matrix& basis = reduced.projection()->basis;
    if (static_cast<double>(spaces.right.cols()) > much * static_cast<double>(basis.cols())) return nullptr;
    AffinePencil<Matrix> pencil = dynamic_cast<const ProjectedFamily&>(reduced).pencil();
    for (auto* terms : {&pencil.M, &pencil.C, &pencil.K}) {
      for (AffineTerm<Matrix>& term : *terms)
        term.matrix = congruence(spaces.left, term.matrix, spaces.right);
    }
    return model_of(std::move(pencil), product(basis, spaces.right), product(basis, spaces.left));
  }

  SmallPencil small(const Model& reduced, const TracePoint& point) const override {
    return small_at(reduced, point.node.path.parameters.col(0));
  }
  SmallPencil small(const Model& reduced, const LargePlace& place, const SparsePencil&,
                    const Matrix&) const override {
    return small_at(reduced, place.parameters);
  }
  ComplexVector coordinates(const TracePoint&, const ComplexVector& shape) const override { return shape; }

  std::optional<Bases> bases(const Model& reduced, const SparsePencil&) const override {
    const Matrix& right = reduced.projection()->basis;
    const Matrix& left = reduced.projection()->left_basis;
    const std::shared_ptr<const Matrix> none;
    return Bases{{none, &right}, {none, left.size() > 0 ? &left : &right}};
  }

 private:
  std::unique_ptr<ProjectedFamily> model_of(AffinePencil<Matrix> pencil, Matrix basis,
                                            Matrix left_basis) const {
    ModelDescription description = family_->description();
    if (description.shafts.empty()) description.effects.clear();  // they are the projected matrices
    Projection projection;
    projection.freedoms = family_->n_coordinates();
    projection.names = std::move(description.coordinate_names);
    projection.basis = std::move(basis);
    projection.left_basis = std::move(left_basis);
    description.coordinate_names.clear();
    for (Eigen::Index i = 0; i < projection.basis.cols(); ++i)
      description.coordinate_names.push_back("x" + std::to_string(i + 1));
    description.coordinate_units.assign(static_cast<std::size_t>(projection.basis.cols()), "1");
    return std::make_unique<ProjectedFamily>(std::move(description), std::move(pencil),
                                             std::move(projection));
  }

  static SmallPencil small_at(const Model& reduced, const Vector& parameters) {
    const AffinePencil<Matrix> at = dynamic_cast<const ProjectedFamily&>(reduced).at(parameters);
    return {at.M.front().matrix, at.C.front().matrix, at.K.front().matrix};
  }

  std::shared_ptr<const SparseFamily> family_;
  FamilyPencils pencils_;
};

}  // namespace

std::unique_ptr<LargeModel> large_model_of(std::shared_ptr<const Model> model, const TraceOptions& trace) {
  if (auto family = std::dynamic_pointer_cast<const SparseFamily>(model))
    return std::make_unique<LargeFamily>(std::move(family));
  return large_scene_of(std::move(model), trace);
}

}  // namespace eigentrail
