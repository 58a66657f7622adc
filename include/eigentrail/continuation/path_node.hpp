// A point of the path as it is stored: its tracks and series. Also the work counters and the setting of a
// run.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "eigentrail/continuation/thresholds.hpp"
#include "eigentrail/modes/all_pairs.hpp"
#include "eigentrail/steady/path_plane.hpp"

namespace eigentrail {

/// A single mode, or a block of close modes that are followed together, at a point.
struct Track {
  /// Entry of `modes` for a member of a block that has no mode number: the member of a complex pair with
  /// Im s < 0 in a block that holds both.
  static constexpr int no_mode = -1;
  /// Entry of `modes` for a guard mode, an eigenvalue that is not followed, but belongs to the block because
  /// it is too close to a followed one.
  static constexpr int guard = -2;

  InvariantPair pair;       ///< in reduced coordinates
  PairSeries series;        ///< Z in physical coordinates, V = T Z
  ComplexMatrix functions;  ///< smooth functions of the block as series (block_functions), order + 2 columns
  ComplexVector roots;      ///< the k eigenvalues of the block in its chart
  std::vector<int> modes;   ///< mode number of every root on the step after the point, from 0
  std::vector<int> arriving;  ///< the same for the step before it; differs where modes begin or end

  /// Set where eigenvalues coincide at the point, so that their order there says nothing: the eigenvalues a
  /// small distance behind the point, where they differ.
  struct Departure {
    double distance = 0.0;  ///< from the point, signed, in the path's coordinate
    ComplexVector roots;    ///< eigenvalues at that distance, in the order of `modes`
  };
  std::optional<Departure> departure;
  bool told_apart = true;  ///< whether its roots could be distinguished on the whole step to this point
  /// Number of the track. It stays the same from point to point until the track is joined, separated or
  /// changes its chart. 0: not yet numbered.
  std::uint64_t lineage = 0;
  /// Eigenvalues of a block that are closer than this stay together, because no certificate could keep them
  /// apart.
  double inseparable = 0.0;
  /// Whether the block has been formed or enlarged for that reason and has not been certified since.
  bool unproven = false;
  std::vector<int> met;  ///< indices of the roots that coincide at the point or have a narrow veering there
  /// Distance from the point, in the path's coordinate, within which rounding hides the members that meet
  /// there: a k-fold eigenvalue is known to the k-th root of rounding.
  double hidden_within = 0.0;

  Eigen::Index size() const { return pair.size(); }
};

/// The data of a point that prediction, dense output, certificate and file need. Series are in powers of the
/// coordinate along the path, measured from the point.
struct PathNode {
  double p = 0.0;  ///< traced parameter, in its unit
  Path path;       ///< series of parameters, x and lambda
  std::vector<Track> tracks;
  Linearization linearization;  ///< series
  TangentBasis basis;           ///< series
  ReducedPencil pencil;         ///< series

  /// Coefficient k of the eigenvalue of a track of one mode, in its chart.
  Complex s(std::size_t track, Eigen::Index k) const { return tracks[track].functions(0, k); }
};

/// Work and wall time of a run, stage by stage. Evaluation counters get their size at the first use.
struct RunCounts {
  EvaluationCounts evaluations;
  ModeCounts modes;
  std::uint64_t equilibrium_iterations = 0;      ///< of KINSOL
  std::uint64_t equilibrium_factorizations = 0;  ///< of the KKT matrix
  std::uint64_t spectra = 0;                     ///< full spectra by QZ
  std::uint64_t event_factorizations = 0;        ///< as ModeCounts::factorizations, for locating events
  std::uint64_t certificate_factorizations = 0;  ///< complex LU; n + k each, or n k + k^2 for small blocks
  std::uint64_t certificate_bases = 0;  ///< inverses of size 2n, each for all modes of a part at once
  double certificate_work = 0.0;        ///< multiplications for the certificate, about
  double certificate_in_vain = 0.0;     ///< those of them for tracks that were not certified
  double equilibrium_seconds = 0.0;     ///< solve and linearize
  double reduction_seconds = 0.0;
  double modes_seconds = 0.0;
  double differentiation_seconds = 0.0;
  double matching_seconds = 0.0;  ///< comparison of modes at both ends of a step, search for missing modes
  double certificate_seconds = 0.0;
  double events_seconds = 0.0;
  double output_seconds = 0.0;

  /// Adds all work of another run.
  RunCounts& operator+=(const RunCounts& other);
};

/// Adds the wall time between its construction and destruction to a counter.
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

/// How the modes of a point are corrected and differentiated. `state_space` and `symmetric` need every mode
/// to be followed. Where the route of a run does not work at a point, the route listed before it is used.
enum class ModeRoute {
  one_by_one,   ///< bordered systems, one mode or block after the other
  state_space,  ///< all at once by products of size 2n (all_pairs.hpp)
  symmetric     ///< all at once by real products of size n: undamped symmetric models (symmetric_pairs.hpp)
};

/// The setting of a run: what does not change from point to point.
struct PathProblem {
  const Model& model;
  int traced = 0;          ///< index of the traced parameter
  Vector parameters = {};  ///< values of all parameters; the traced entry is replaced at each point
  Structure structure = {};
  int order = 3;         ///< of the dense output; series have one more coefficient, for the error estimate
  double s_ref = 1.0;    ///< magnitude below which an eigenvalue counts as zero, 1/s
  double s_max = 1e300;  ///< magnitude above which an eigenvalue counts as infinite, 1/s
  int threads = 1;       ///< threads that share the modes of a point, >= 1
  ModeRoute route = ModeRoute::one_by_one;  ///< the cheapest route that the model allows
  BasisChoice basis = BasisChoice::aligned;
  /// Whether the positions at equilibrium are the same on the whole path, and only the multipliers change.
  bool rests = false;
  /// Constant coordinates in which the equations fall apart or are balanced; null where they do not.
  std::shared_ptr<const IndependentParts> parts = {};
  SteadyOptions steady = {};
  CorrectorOptions corrector = {};
  Thresholds thresholds = {};

  /// Magnitude below which the eigenvalue mu of a chart (s or 1/s) counts as zero.
  double reference(Chart chart) const { return chart == Chart::finite ? s_ref : 1.0 / s_max; }
};

}  // namespace eigentrail
