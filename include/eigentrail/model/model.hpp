// The one abstract interface: what the engine asks of a mechanical system.
//
//   M(x, p) x'' + A^T lambda = f(x, x', p),   c(x, p) = 0,   A = c_/x          (seed paper, Eqs. 3a, 3b)
//
// A model answers with power series along a path (x(h), lambda(h), p(h)), so its derivatives are total
// derivatives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "eigentrail/core/extended.hpp"
#include "eigentrail/core/system_matrix.hpp"
#include "eigentrail/core/types.hpp"
#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// What an effect contributes to the linearized equations; the structure of the pencil follows from these
/// alone.
struct Contribution {
  bool inertia = false;       ///< symmetric M
  bool conservative = false;  ///< symmetric K
  bool circulatory = false;   ///< unsymmetric K
  bool dissipative = false;   ///< symmetric C
  bool gyroscopic = false;    ///< skew-symmetric C
  bool constraint = false;    ///< rows of A, and the symmetric (A^T lambda)_/x
};

/// An effect of the scene, or one that a scene could name.
struct Effect {
  std::string name;           ///< the key that calls for it: "rod"
  std::string description;    ///< one line
  int count = 0;              ///< how often the scene names it; 0: absent, never evaluated
  Contribution contribution;  ///< of each of them
  int evaluations = 0;        ///< of its formula (constraints: rows) for all of them in one linearization
};

/// What is known about the pencil before a number is computed, for a given traced parameter.
struct Structure {
  bool symmetric_mass = true;
  bool damped = false;
  bool gyroscopic = false;
  bool circulatory = false;
  bool constant_mass = false;  ///< M does not change along the path; likewise below
  bool constant_damping = false;
  bool constant_stiffness = false;    ///< K + (A^T lambda)_/x
  bool constant_constraints = false;  ///< A: the tangent basis is kept
  bool fixed_equilibrium = false;     ///< x0 and lambda0 do not move: KINSOL is called once at most
  bool known_equilibrium = false;     ///< the initial guess is the equilibrium: KINSOL is never called
};

/// Unchanging facts about a model.
struct ModelDescription {
  std::vector<std::string> coordinate_names;  ///< size n
  std::vector<std::string> coordinate_units;  ///< size n
  std::vector<std::string> constraint_names;  ///< size m
  std::vector<Effect> effects;
  Parameters parameters;
};

/// Steady equations A^T lambda - f(x, 0, p) = 0 and c(x, p) = 0 as series (Eqs. 14a, 14b).
template <class Real>
struct BasicSteadyResidual {
  using Columns = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Columns force;       ///< n x (order + 1): A^T lambda - f
  Columns constraint;  ///< m x (order + 1): c
};
using SteadyResidual = BasicSteadyResidual<double>;

/// Linearization about the path as series (Eqs. 16a, 16b); all derivatives are total along the path.
template <class Real>
struct BasicLinearization {
  using Coefficients = std::vector<BasicSystemMatrix<Real>>;
  Coefficients M;  ///< n x n
  Coefficients C;  ///< n x n, -f_/x'
  Coefficients K;  ///< n x n, -f_/x + (A^T lambda)_/x
  Coefficients A;  ///< m x n
};
using Linearization = BasicLinearization<double>;

/// Evaluations of each effect (index as in ModelDescription::effects), summed over a run.
struct EvaluationCounts {
  std::vector<std::uint64_t> residual;
  std::vector<std::uint64_t> linearization;
};

/// A number that is not finite: where it came from. Empty `source` means all numbers were finite.
struct EvaluationFault {
  std::string source;
  explicit operator bool() const { return !source.empty(); }
};

/// Models are immutable; const calls may run in several threads, each with its own `counts`.
class Model {
 public:
  virtual ~Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const ModelDescription& description() const { return description_; }
  Eigen::Index n_coordinates() const {
    return static_cast<Eigen::Index>(description_.coordinate_names.size());
  }
  Eigen::Index n_constraints() const {
    return static_cast<Eigen::Index>(description_.constraint_names.size());
  }

  /// Starting guess for x at given parameters (declared units).
  virtual Vector initial_guess(const Vector& parameters) const = 0;

  /// Structure for a path along which only the parameter with this index changes by itself.
  virtual Structure structure(int traced_parameter) const = 0;

  /// Residual of the steady equations along `path` up to h^order, 0 <= order <= max_order.
  virtual EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                                   EvaluationCounts& counts) const = 0;

  /// M, C, K + (A^T lambda)_/x and A along `path` up to h^order.
  virtual EvaluationFault linearize(const Path& path, int order, Linearization& result,
                                    EvaluationCounts& counts) const = 0;

  /// The same two at a point, of order 0, with 113 bits: for references. A model that does not have them
  /// answers with a fault.
  virtual EvaluationFault extended_residual(const BasicPath<Extended>&,
                                            BasicSteadyResidual<Extended>&) const {
    return {"a model without extended precision"};
  }
  virtual EvaluationFault extended_linearization(const BasicPath<Extended>&,
                                                 BasicLinearization<Extended>&) const {
    return {"a model without extended precision"};
  }

  /// Counters of the right size, all zero.
  EvaluationCounts new_counts() const {
    const std::size_t n = description_.effects.size();
    return {std::vector<std::uint64_t>(n, 0), std::vector<std::uint64_t>(n, 0)};
  }

 protected:
  explicit Model(ModelDescription description) : description_(std::move(description)) {}

 private:
  ModelDescription description_;
};

}  // namespace eigentrail
