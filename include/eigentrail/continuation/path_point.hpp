// One point of the path, in five calls: solve the equilibrium, linearize, reduce, correct the modes,
// differentiate.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/modes/mode.hpp"
#include "eigentrail/steady/equilibrium.hpp"

namespace eigentrail {

/// What a point leaves behind for prediction, dense output and the file.
struct PathNode {
  double p = 0.0;                           ///< traced parameter, in its unit
  Path path;                                ///< equilibrium series
  ComplexMatrix s;                          ///< modes x (order + 1): eigenvalue series
  std::vector<ComplexVectorSeries> shapes;  ///< per mode, n x (order + 1): physical vector v = T z
  Vector backward_error, condition;         ///< per mode
  Matrix mass;                              ///< n x n, weight of the modal assurance criterion
  Matrix basis;                             ///< n x (n - rank)
};

/// Work and wall time of a run, stage by stage. Evaluation counters take their size at the first use.
struct RunCounts {
  EvaluationCounts evaluations;
  ModeCounts modes;
  std::uint64_t equilibrium_iterations = 0;      ///< of KINSOL
  std::uint64_t equilibrium_factorizations = 0;  ///< of the KKT matrix
  double equilibrium_seconds = 0.0;              ///< solve and linearize
  double reduction_seconds = 0.0;
  double modes_seconds = 0.0;
  double differentiation_seconds = 0.0;
  double matching_seconds = 0.0;  ///< comparison with the prediction
  double output_seconds = 0.0;
};

/// Adds the time between construction and destruction to a counter.
class StageTimer {
 public:
  explicit StageTimer(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~StageTimer() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

/// The setting of a run: what does not change from point to point.
struct PathProblem {
  const Model& model;
  int traced = 0;          ///< index of the traced parameter
  Vector parameters = {};  ///< declared values; the traced entry is replaced at each point
  Structure structure = {};
  int order = 3;
  double s_ref = 1.0;  ///< magnitude below which an eigenvalue counts as zero, 1/s
  BasisChoice basis = BasisChoice::aligned;
  SteadyOptions steady = {};
  CorrectorOptions corrector = {};
};

/// The problem of following `model` along the parameter of that name, all others at their declared values.
/// Throws std::bad_optional_access when the model has no such parameter.
PathProblem problem_along(const Model& model, const std::string& parameter);

/// Where an equilibrium is looked for.
struct EquilibriumGuess {
  Vector x;
  Vector lambda;        ///< empty: the least-squares multipliers at x
  bool solved = false;  ///< an equilibrium of a neighbouring point, or its series; not the scene's own guess
};

/// Where the next point is expected.
struct Prediction {
  EquilibriumGuess equilibrium;
  ComplexVector s;       ///< per mode
  ComplexMatrix shapes;  ///< n x modes, physical vectors
};

enum class PointStatus { computed, no_equilibrium, mode_lost };

/// A point whose modes are corrected but not yet differentiated.
struct PathPoint {
  PointStatus status = PointStatus::computed;
  std::string message;  ///< reason when not computed
  int lost_mode = -1;   ///< the mode that was not corrected
  double p = 0.0;
  Equilibrium equilibrium;
  TangentBasis basis;
  ReducedPencil pencil;  ///< of order 0
  std::vector<Mode> modes;

  ComplexVector eigenvalues() const;
  ComplexMatrix shapes() const;  ///< n x modes, v = T z
};

/// Parameters at p, in declared units.
Vector parameters_at(const PathProblem& problem, double p);

/// Equilibrium, linearization and reduction at p; no modes yet.
PathPoint reduce_at(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                    const Matrix& previous_basis, RunCounts& counts);

/// The whole point, from a prediction.
PathPoint compute_point(const PathProblem& problem, double p, const Prediction& prediction,
                        const Matrix& previous_basis, RunCounts& counts);

/// Differentiates a computed point to the order of the problem along the traced parameter. Empty when a
/// series coefficient is not finite.
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            RunCounts& counts);

/// The same along another parameter, all others held: the sensitivities of the equilibrium and of the modes
/// to it. The factorizations of the point are reused, so each further parameter costs back-substitutions only
/// (seed paper, end of Sect. 4.3).
std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point, int parameter,
                                            RunCounts& counts);

}  // namespace eigentrail
