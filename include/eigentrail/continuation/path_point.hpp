// One point of the path, in five calls: solve the equilibrium, linearize, reduce, correct the modes,
// differentiate.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/thresholds.hpp"
#include "eigentrail/modes/all_pairs.hpp"
#include "eigentrail/steady/path_plane.hpp"

namespace eigentrail {

struct SymmetricPairs;

/// A mode, or a block of close ones, at a point.
struct Track {
  static constexpr int no_mode =
      -1;                           ///< member of a block that is no mode of its own: the lower one of a pair
  static constexpr int guest = -2;  ///< member that is not followed, but too close to leave out

  InvariantPair pair;         ///< in reduced coordinates
  PairSeries series;          ///< Z in physical coordinates, V = T Z
  ComplexMatrix functions;    ///< k x (order + 2): smooth functions of the block (block_functions)
  ComplexVector roots;        ///< eigenvalues of the block in its chart
  std::vector<int> modes;     ///< the mode of every root from here on, from 0
  std::vector<int> arriving;  ///< the same up to here; differs where modes are born or die

  /// Where eigenvalues meet at the point: who is who a little later, when that is known.
  struct Departure {
    double distance = 0.0;  ///< in the path's coordinate
    ComplexVector roots;    ///< in the order of `modes`
  };
  std::optional<Departure> departure;
  bool told_apart = true;  ///< its roots were, all the way from the last point
  /// The same number from point to point as long as it is followed as it is; 0: not yet numbered.
  std::uint64_t lineage = 0;
  bool passed = false;   ///< stands as it was continued from the last step
  std::vector<int> met;  ///< indices of the roots that meet at the point, or veer closely

  Eigen::Index size() const { return pair.size(); }
};

/// What a point leaves behind for prediction, dense output, certificate and the file.
struct PathNode {
  double p = 0.0;  ///< traced parameter, in its unit
  Path path;       ///< equilibrium series
  std::vector<Track> tracks;
  Linearization linearization;  ///< series
  TangentBasis basis;           ///< series
  ReducedPencil pencil;         ///< series

  /// Coefficient k of the eigenvalue of a track of one mode.
  Complex s(std::size_t track, Eigen::Index k) const { return tracks[track].functions(0, k); }
};

/// Work and wall time of a run, stage by stage. Evaluation counters take their size at the first use.
struct RunCounts {
  EvaluationCounts evaluations;
  ModeCounts modes;
  std::uint64_t equilibrium_iterations = 0;      ///< of KINSOL
  std::uint64_t equilibrium_factorizations = 0;  ///< of the KKT matrix
  std::uint64_t spectra = 0;                     ///< full spectra by QZ
  std::uint64_t event_factorizations = 0;        ///< as ModeCounts::factorizations, to locate special points
  std::uint64_t certificate_factorizations = 0;  ///< complex LU of size n + 1 (blocks: n k + k^2)
  std::uint64_t certificate_bases = 0;           ///< inverses of size 2n that serve all modes at once
  double equilibrium_seconds = 0.0;              ///< solve and linearize
  double reduction_seconds = 0.0;
  double modes_seconds = 0.0;
  double differentiation_seconds = 0.0;
  double matching_seconds = 0.0;  ///< identity, completeness
  double certificate_seconds = 0.0;
  double events_seconds = 0.0;
  double output_seconds = 0.0;

  /// Adds all work of another run.
  RunCounts& operator+=(const RunCounts& other);
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

/// How the modes of a point are corrected and differentiated. A route serves points at which every mode is
/// followed and that meet its conditions; the others are left to the next one above it.
enum class ModeRoute {
  one_by_one,   ///< bordered systems, one mode or block after the other
  state_space,  ///< all at once by products of size 2n (all_pairs.hpp)
  symmetric     ///< all at once by real products of size n: no damping, symmetric (symmetric_pairs.hpp)
};

/// The setting of a run: what does not change from point to point.
struct PathProblem {
  const Model& model;
  int traced = 0;          ///< index of the traced parameter
  Vector parameters = {};  ///< declared values; the traced entry is replaced at each point
  Structure structure = {};
  int order = 3;         ///< of the dense output; series have one coefficient more, for its error
  double s_ref = 1.0;    ///< magnitude below which an eigenvalue counts as zero, 1/s
  double s_max = 1e300;  ///< magnitude above which it counts as infinite
  int threads = 1;       ///< for the modes of a point, >= 1
  ModeRoute route = ModeRoute::one_by_one;  ///< the cheapest one that the model allows
  BasisChoice basis = BasisChoice::aligned;
  SteadyOptions steady = {};
  CorrectorOptions corrector = {};
  Thresholds thresholds = {};

  /// Magnitude below which the eigenvalue of a chart counts as zero.
  double reference(Chart chart) const { return chart == Chart::finite ? s_ref : 1.0 / s_max; }
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

/// A single mode as the dense output of the last step goes on, at the next point.
struct ContinuedMode {
  InvariantPair pair;  ///< Z in physical coordinates
  PairSeries series;   ///< the same
};

/// Where the next point is expected.
struct Prediction {
  double p = 0.0;
  EquilibriumGuess equilibrium;
  std::vector<InvariantPair> pairs;  ///< Z in physical coordinates
  /// Per pair another prediction, which may be good enough to stand; empty where there is none.
  std::vector<std::optional<ContinuedMode>> continued = {};
  /// Whether the one of that pair may stand; asked, by several threads at once, where it is accurate enough.
  std::function<bool(const ContinuedMode&, std::size_t)> may_pass = {};
  /// Per pair its track where the same point was computed before, or null; empty where there is none.
  std::vector<const Track*> ready = {};
  std::optional<PathPlane> plane = {};  ///< where p is not given but found: the plane that the point lies on
  std::optional<Path> known = {};       ///< the equilibrium's series, where it cannot be solved for
};

enum class PointStatus { computed, no_equilibrium, mode_lost };

/// A point whose modes are corrected but not yet differentiated.
struct PathPoint {
  PointStatus status = PointStatus::computed;
  std::string message;  ///< reason when not computed
  int lost_track = -1;  ///< the track that was not corrected
  double p = 0.0;
  std::optional<PathPlane> plane;
  std::optional<Path> known;  ///< as in Prediction
  Equilibrium equilibrium;
  TangentBasis basis;
  ReducedPencil pencil;  ///< of order 0
  std::vector<InvariantPair> pairs;
  std::shared_ptr<const AllPairs> all;                 ///< where the pairs were corrected in state space
  std::shared_ptr<const SymmetricPairs> symmetric;     ///< where they were corrected by the symmetric route
  std::vector<std::optional<PairSeries>> passed = {};  ///< of pairs that stand as they were continued
  std::vector<const Track*> ready = {};                ///< as in Prediction

  /// V = T Z of a pair.
  ComplexMatrix shapes(std::size_t pair) const;
};

/// Whether that many modes of a pencil of size n are worth more than one thread.
bool is_worth_sharing(std::size_t modes, Eigen::Index n);

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

/// Series of one block at a point that is already differentiated.
Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts);

}  // namespace eigentrail
