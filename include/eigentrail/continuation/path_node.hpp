// A point of the path as it is kept: its tracks and series. With it, what a run counts, and the setting of a
// run.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/thresholds.hpp"
#include "eigentrail/modes/all_pairs.hpp"
#include "eigentrail/steady/path_plane.hpp"

namespace eigentrail {

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

}  // namespace eigentrail
