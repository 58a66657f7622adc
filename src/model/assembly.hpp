// The equations of a multibody model and their derivatives along a path, from its recorded elements and
// constraints.
#pragma once

#include <initializer_list>
#include <memory>
#include <tuple>

#include "model/path_values.hpp"
#include "model/recorded_equations.hpp"

namespace eigentrail {

template <class Real>
struct AssemblyWork;

/// Immutable. Several threads may evaluate at the same time; each takes memory of its own, which stays with
/// the assembly.
class Assembly {
 public:
  explicit Assembly(MultibodyData data);
  ~Assembly();
  Assembly(Assembly&&) noexcept;
  Assembly& operator=(Assembly&&) noexcept;

  const MultibodyData& data() const { return data_; }
  const RecordedEquations& equations() const { return equations_; }

  /// The model's coordinate of a coordinate of points and bodies: they come first.
  Eigen::Index coordinate(std::size_t of_scene) const { return static_cast<Eigen::Index>(of_scene); }
  /// A description with the costs of what is recorded added to its effects.
  ModelDescription with_costs(ModelDescription description) const;
  /// As Model::structure, while the `moving` parameters change: the traced one and the unknowns of trims.
  Structure structure(const std::vector<int>& moving) const;

  /// Real is double, or Extended for reference solutions; 0 <= order <= max_order.
  template <class Real>
  EvaluationFault residual(const BasicPath<Real>& path, int order, BasicSteadyResidual<Real>& result,
                           EvaluationCounts& counts) const;
  template <class Real>
  EvaluationFault linearize(const BasicPath<Real>& path, int order, BasicLinearization<Real>& result,
                            EvaluationCounts& counts) const;

  /// Derivatives of the conditions of the trim with respect to x and lambda at a point: `x` and `lambda` of
  /// `result`.
  EvaluationFault trim_rows(const Path& at, TrimDerivatives& result, EvaluationCounts& counts) const;

 private:
  template <class Real>
  class Lease;
  template <class Real>
  struct Pool;

  template <class Real>
  void set_path(AssemblyWork<Real>& work, const BasicPath<Real>& path, int order) const;
  template <class Real>
  EvaluationFault condition(std::size_t trim, AssemblyWork<Real>& work, Series<Real, max_order>& value,
                            EvaluationCounts& counts) const;
  EvaluationFault load_row(std::size_t trim, AssemblyWork<double>& work, Vector& of_x,
                           TrimDerivatives& result, EvaluationCounts& counts) const;
  template <class Real>
  Pool<Real>& pool() const {
    return *std::get<std::unique_ptr<Pool<Real>>>(pools_);
  }

  MultibodyData data_;
  RecordedEquations equations_;
  std::vector<RecordedEquations> conditions_;  ///< by trim: its load, or its one equation
  Program quantity_values_;                    ///< those that depend on parameters, of the parameters
  std::vector<int> varying_;                   ///< slot of each value of `quantity_values_`
  std::tuple<std::unique_ptr<Pool<double>>, std::unique_ptr<Pool<Extended>>> pools_;
};

/// Structure of the equations of several parts of a model together, as Assembly::structure.
Structure structure_of(std::initializer_list<const Assembly*> parts, const std::vector<int>& moving);

}  // namespace eigentrail
