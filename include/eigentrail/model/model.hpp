// The interface through which the solver evaluates a mechanical system.
//
//   M(x, p) x'' + A^T lambda = f(x, x', p),   c(x, p) = 0,   A = c_/x          (seed paper, Eqs. 3a, 3b)
//
// A model may have k trimmed parameters u, unknowns that k conditions g(x, lambda, u, p) = 0 determine at the
// equilibrium; in the motion about it they are constant. The rows of u follow those of lambda in a path and
// take the place of the values in its parameters; the rows of g follow those of c in a residual.
//
// A model returns power series along a path (x(h), lambda(h), p(h)); all derivatives are total derivatives
// along it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eigentrail/core/extended.hpp"
#include "eigentrail/core/system_matrix.hpp"
#include "eigentrail/core/types.hpp"
#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// Contributions of an effect to the linearized equations. They determine the structure of the pencil.
struct Contribution {
  bool inertia = false;       ///< symmetric M
  bool conservative = false;  ///< symmetric K
  bool circulatory = false;   ///< unsymmetric K
  bool dissipative = false;   ///< symmetric C
  bool gyroscopic = false;    ///< skew-symmetric C
  bool constraint = false;    ///< rows of A, and the symmetric (A^T lambda)_/x
};

/// An effect that occurs or may occur in the scene.
struct Effect {
  std::string name;           ///< key of its tables in the scene, such as "rod"
  std::string description;    ///< one line
  int count = 0;              ///< number of its occurrences in the scene; 0: never evaluated
  Contribution contribution;  ///< contribution of each occurrence
  int records = 0;            ///< different structures of its occurrences; their operations are recorded once
  int directions = 0;         ///< of differentiation on which the forces of one occurrence depend, the most
  int operations = 0;         ///< on numbers or power series for all occurrences in one linearization
  /// First-order coordinates that belong to its occurrences, one per state; they are the last coordinates of
  /// the model.
  int states = 0;
};

/// Structure of the pencil that is known before its evaluation, for a given traced parameter.
struct Structure {
  bool symmetric_mass = true;
  bool damped = false;
  bool gyroscopic = false;
  bool circulatory = false;
  bool constant_mass = false;  ///< M is constant along the path; likewise below
  bool constant_damping = false;
  bool constant_stiffness = false;    ///< K + (A^T lambda)_/x
  bool constant_constraints = false;  ///< A is constant: the tangent basis is kept
  bool fixed_equilibrium = false;     ///< x0 and lambda0 do not change: KINSOL is called once at most
  bool known_equilibrium = false;     ///< the initial guess is the equilibrium: KINSOL is never called

  /// Adds what forces contribute.
  void add(const Contribution& part) {
    damped = damped || part.dissipative;
    gyroscopic = gyroscopic || part.gyroscopic;
    circulatory = circulatory || part.circulatory;
  }

  /// Whether with s also -conj(s) is an eigenvalue: without damping, if there are no gyroscopic terms or the
  /// system is Hamiltonian.
  bool reflects_spectrum() const { return !damped && (!gyroscopic || (symmetric_mass && !circulatory)); }
};

/// How the blades of a rotor move together, in multiblade coordinates: as functions of the azimuth psi of a
/// blade in the frame that stands.
struct BladeWave {
  /// "collective", "differential", or a wave: "progressive" turns with the rotor, "regressive" against it,
  /// both in the frame that stands; with "2", "3", ... for cos(2 psi), ... Empty: not of a blade.
  std::string name;
  int harmonic = 0;  ///< n of cos(n psi) and sin(n psi); 0 if collective or differential
  int sense = 0;     ///< of a wave: 1 progressive, -1 regressive
  Eigen::Index rest_triple =
      -1;  ///< first triple of the collective coordinates, where the blades are at rest
  Eigen::Index sine_triple =
      -1;  ///< of a wave: first triple of the sine coordinates; the carrier's own is the cosine
};

/// A point (one triple of coordinates) or a body (four triples: its origin and its directors) of a multibody
/// model. Its mass matrix is the Kronecker product of its constant moments G (1 x 1 or 4 x 4) and the 3 x 3
/// identity matrix.
struct MassCarrier {
  std::string name;
  Eigen::Index first_triple = 0;
  Eigen::Index n_triples = 1;
  bool stands = false;  ///< whether it does not turn with the rotating frame: the support of a rotor
  BladeWave wave = {};  ///< of the blades of a rotor
};

/// A rotor of equal blades on a support that stands, in multiblade coordinates.
struct BladedRotor {
  int blades = 0;
  std::string hub;                    ///< name of the body that carries them
  Expression speed;                   ///< about +z, rad/s
  std::vector<std::string> of_blade;  ///< points and bodies of one blade
  std::vector<std::string> support;   ///< points and bodies that stand, with the hub
};

/// Something that rotates about the z axis and carries nodes: a shaft. The orbits of its nodes show whether a
/// mode whirls with its rotation or against it.
struct SpinningShaft {
  std::string name;
  Expression speed;            ///< about +z, rad/s
  std::vector<double> places;  ///< of the nodes along the axis, m, at the declared values of the parameters
  std::vector<std::array<Eigen::Index, 2>> nodes;  ///< coordinates x and y of each node; -1: held
};

/// A direction of a body about which a disc spins: first coordinates of the body's origin and of the
/// director.
struct SpinningAxis {
  Eigen::Index origin = 0, director = 0;
  Expression speed;  ///< rad/s
};

/// A parameter that is solved for together with the equilibrium, so that a condition holds there.
struct Trim {
  int parameter = -1;     ///< index of the unknown; its declared value is the starting guess
  std::string condition;  ///< as the scene states it: "thrust(rotor) = weight"
};

/// Constant properties of a model.
struct ModelDescription {
  std::vector<std::string> coordinate_names;     ///< size n
  std::vector<std::string> coordinate_units;     ///< size n
  std::vector<std::string> constraint_names;     ///< size m
  std::vector<Trim> trims = {};                  ///< size k
  std::vector<Effect> effects;                   ///< the states of elements follow their order
  std::vector<MassCarrier> masses;               ///< only of a multibody model
  std::optional<Eigen::Vector3d> rotation_axis;  ///< unit vector; empty if the frame does not rotate
  Parameters parameters;
  std::vector<SpinningShaft> shafts = {};  ///< of a rotor
  std::vector<SpinningAxis> spins = {};    ///< of discs on the bodies of a multibody model
  std::optional<BladedRotor> rotor = {};   ///< if the model has blades in multiblade coordinates
  /// Whether dependent constraints share the load by least squares, as the scene says; else a stiffness that
  /// depends on how they do is refused.
  bool shares_reactions = false;
  /// What is known of the model's data, for users: a label and a text each ("digits", "4 significant").
  std::vector<std::pair<std::string, std::string>> data = {};
  /// Indices of the parameters on which nothing in the scene depends.
  std::vector<int> unused_parameters = {};
};

/// Residual of the steady equations A^T lambda - f(x, 0, p) = 0 and c(x, p) = 0 as power series (Eqs. 14a,
/// 14b).
template <class Real>
struct BasicSteadyResidual {
  using Columns = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Columns force;       ///< n x (order + 1): A^T lambda - f
  Columns constraint;  ///< (m + k) x (order + 1): c, and the conditions g
};
using SteadyResidual = BasicSteadyResidual<double>;

/// Linearization about the path as power series (Eqs. 16a, 16b); all derivatives are total derivatives along
/// the path.
template <class Real>
struct BasicLinearization {
  using Coefficients = std::vector<BasicSystemMatrix<Real>>;
  Coefficients M;  ///< n x n
  Coefficients C;  ///< n x n, -f_/x'
  Coefficients K;  ///< n x n, -f_/x + (A^T lambda)_/x
  Coefficients A;  ///< m x n
};
using Linearization = BasicLinearization<double>;

/// First derivatives, at a point, that a trim adds to those of the linearization.
struct TrimDerivatives {
  Matrix force, constraint;  ///< n x k, m x k: of A^T lambda - f and of c with respect to u
  Matrix x, lambda, trim;    ///< k x n, k x m, k x k: of the conditions g with respect to x, lambda and u
};

/// Constant matrices, n x n, of which M, C and K are linear combinations.
struct CoefficientMatrices {
  std::vector<Matrix> M, C, K;
};

/// Number of evaluations of each effect (index as in ModelDescription::effects), summed over a run.
struct EvaluationCounts {
  std::vector<std::uint64_t> residual;
  std::vector<std::uint64_t> linearization;
};

/// Reports that the equations have no values: usually a number that is not finite.
struct EvaluationFault {
  std::string source;       ///< origin of the number; empty: no fault
  std::string reason = {};  ///< what is wrong in place of such a number, a sentence without its end
  explicit operator bool() const { return !source.empty(); }
  std::string message() const {
    return reason.empty() ? "a number that is not finite came out of " + source : reason;
  }
};

class SampleErrors;
struct Projection;

/// Models are immutable. Const functions may be called from several threads, each with its own `counts`.
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
  Eigen::Index n_trims() const { return static_cast<Eigen::Index>(description_.trims.size()); }
  /// m + k: rows of lambda in a path.
  Eigen::Index n_multipliers() const { return n_constraints() + n_trims(); }

  /// lambda of a path for a first guess: multipliers zero, and the trimmed parameters as in `parameters`.
  Vector first_multipliers(const Vector& parameters) const {
    Vector lambda = Vector::Zero(n_multipliers());
    for (Eigen::Index i = 0; i < n_trims(); ++i)
      lambda[n_constraints() + i] = parameters[description_.trims[static_cast<std::size_t>(i)].parameter];
    return lambda;
  }

  /// Starting guess for x at given parameters (declared units).
  virtual Vector initial_guess(const Vector& parameters) const = 0;

  /// Structure for a path along which only the parameter with this index is changed directly; parameters that
  /// are derived from it change with it.
  virtual Structure structure(int traced_parameter) const = 0;

  /// Residual of the steady equations along `path` up to h^order, 0 <= order <= max_order.
  virtual EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                                   EvaluationCounts& counts) const = 0;

  /// M, C, K + (A^T lambda)_/x and A along `path` up to h^order.
  virtual EvaluationFault linearize(const Path& path, int order, Linearization& result,
                                    EvaluationCounts& counts) const = 0;

  /// The derivatives at a point that belong to the trimmed parameters. Called only if there are any.
  virtual EvaluationFault trim_derivatives(const Path& /*at*/, TrimDerivatives& /*result*/,
                                           EvaluationCounts& /*counts*/) const {
    return {"a model without trimmed parameters"};
  }

  /// Constant matrices of which M, C and K are linear combinations for every value of the parameter with
  /// index `traced`, while the others stay as in `parameters` (declared units); none if they are not known or
  /// there are constraints. Common structure of these matrices holds on the whole trace.
  virtual CoefficientMatrices coefficient_matrices(const Vector& /*parameters*/, int /*traced*/) const {
    return {};
  }

  /// Expressions of the parameters on which the equations depend, besides the definitions of parameters. A
  /// trace looks at them between its points.
  virtual std::vector<Expression> expressions() const { return {}; }

  /// Values of the traced parameter (declared unit), ascending, at which the equations have a kink. A trace
  /// lands just before and just behind them; at a kink the model is that before it.
  virtual std::vector<double> kinks([[maybe_unused]] int traced_parameter) const { return {}; }

  /// Values of the traced parameter (declared unit), ascending, between which the equations may change on a
  /// small part of the range. A trace lands there.
  virtual std::vector<double> landings([[maybe_unused]] int traced_parameter) const { return {}; }

  /// Errors of the eigenvalues that come from the data of the model; null if it has none of its own.
  virtual const SampleErrors* sample_errors() const { return nullptr; }

  /// The large model that this one is a projection of; null if it is none.
  virtual const Projection* projection() const { return nullptr; }

  /// residual and linearize at a point (order 0) with 113 bits, for reference solutions. A model that does
  /// not support them returns a fault.
  virtual EvaluationFault extended_residual(const BasicPath<Extended>&,
                                            BasicSteadyResidual<Extended>&) const {
    return {"a model without extended precision"};
  }
  virtual EvaluationFault extended_linearization(const BasicPath<Extended>&,
                                                 BasicLinearization<Extended>&) const {
    return {"a model without extended precision"};
  }

  /// Counters for this model, all zero.
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
