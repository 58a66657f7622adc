// The equations of a multibody model and their derivatives along a path, from its recorded elements and
// constraints.
#pragma once

#include <memory>
#include <mutex>

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
  Pool<Real>& pool() const;

  MultibodyData data_;
  RecordedEquations equations_;
  std::vector<RecordedEquations> conditions_;  ///< by trim: its load, or its one equation
  Program quantity_values_;                    ///< those that depend on parameters, of the parameters
  std::vector<int> varying_;                   ///< slot of each value of `quantity_values_`
  std::unique_ptr<Pool<double>> doubles_;
  std::unique_ptr<Pool<Extended>> extended_;
};

}  // namespace eigentrail
