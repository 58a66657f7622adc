#include "eigentrail/continuation/point_modes.hpp"

#include "core/matrix_series.hpp"
#include "core/parallel.hpp"
#include "core/products.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "eigentrail/modes/symmetric_pairs.hpp"

namespace eigentrail {

bool is_worth_sharing(std::size_t modes, Eigen::Index n) {
  // modes n^3 above which several threads are used: starting one costs about 20 us. Affects only the time.
  constexpr double least_work = 3e5;
  const auto size = static_cast<double>(n);
  return static_cast<double>(modes) * size * size * size > least_work;
}

namespace {

/// Calls work(i, counts) for every mode, on several threads if that pays, and adds up the counts.
template <class Work>
void for_every_mode(const PathProblem& problem, std::size_t modes, Eigen::Index n, ModeCounts& counts,
                    Work&& work) {
  std::vector<ModeCounts> own(modes);
  // In reverse order: blocks are behind single modes and take longer. If they came last, one thread would
  // work on a block while the others have ended.
  in_parallel(modes, is_worth_sharing(modes, n) ? problem.threads : 1,
              [&](std::size_t i) { work(modes - 1 - i, own[modes - 1 - i]); });
  for (const ModeCounts& some : own) counts += some;
}

/// Corrects the pairs at a reduced point one by one, starting from their predictions.
class ModeCorrections {
 public:
  ModeCorrections(const PathProblem& problem, const Prediction& prediction, PathPoint& point)
      : problem_(problem),
        prediction_(prediction),
        point_(point),
        projection_(point.basis.is_identity || point.basis.parts ? Matrix()
                                                                 : Matrix(point.basis.T[0].transpose())) {
    const std::size_t parts = std::max<std::size_t>(point.pencil.parts.size(), 1);
    for (std::size_t i = 0; i < parts; ++i) {
      const ReducedPencil& pencil = point.pencil.of(static_cast<int>(i));
      finite_.emplace_back(pencil, Chart::finite);
      reciprocal_.emplace_back(pencil, Chart::reciprocal);
    }
    point.pairs.resize(prediction.pairs.size());
    point.passed.resize(prediction.pairs.size());
    point.ready = prediction.ready;
  }

  /// Sets pair i: from an earlier computation of the point, or as extrapolated if that is accurate enough, or
  /// corrected from the better of both predictions.
  void correct(std::size_t i, ModeCounts& counts) {
    if (i < prediction_.ready.size() && prediction_.ready[i] != nullptr) {
      point_.pairs[i] = prediction_.ready[i]->pair;
      return;
    }
    InvariantPair start = reduced(prediction_.pairs[i]);
    const PencilAtPoint& pencil =
        (start.chart == Chart::finite ? finite_ : reciprocal_)[static_cast<std::size_t>(start.part)];
    const double reference = problem_.reference(start.chart);
    if (i < prediction_.continued.size() && prediction_.continued[i]) {
      InvariantPair other = reduced(prediction_.continued[i]->pair);
      normalize_pair(other.Z, other.Lambda, other.W, reference);
      other.backward_error = backward_error(pencil, other);
      if (other.condition * other.backward_error <= problem_.corrector.passing_error &&
          prediction_.may_pass(*prediction_.continued[i], i)) {
        other.status = PairStatus::converged;
        point_.pairs[i] = std::move(other);
        point_.passed[i] = prediction_.continued[i]->series;
        ++counts.passed;
        return;
      }
      if (other.backward_error < backward_error(pencil, start)) start = std::move(other);
    }
    point_.pairs[i] = correct_pair(pencil, start, reference, problem_.corrector, counts);
  }

  std::vector<InvariantPair> starts() const {
    std::vector<InvariantPair> all;
    for (const InvariantPair& pair : prediction_.pairs) all.push_back(reduced(pair));
    return all;
  }

  /// The pencil as a whole; it must not fall apart.
  const PencilAtPoint& finite() const { return finite_.front(); }

 private:
  InvariantPair reduced(InvariantPair pair) const {
    if (projection_.size() > 0) pair.Z = multiply(projection_, pair.Z);
    if (point_.basis.parts) pair.Z = point_.basis.coordinates(pair.Z, pair.part);
    return pair;
  }

  const PathProblem& problem_;
  const Prediction& prediction_;
  PathPoint& point_;
  Matrix projection_;                               ///< T^T; empty where T is the identity or constant
  std::vector<PencilAtPoint> finite_, reciprocal_;  ///< of every part of the equations
};

/// Corrects the predicted pairs all at once, if the problem allows that and it works at this point.
bool correct_together(const PathProblem& problem, const Prediction& prediction,
                      const ModeCorrections& corrections, PathPoint& point, ModeCounts& counts) {
  if (problem.route == ModeRoute::one_by_one || !point.pencil.parts.empty() ||
      !is_complete(prediction.pairs, state_size(point.pencil.M[0])))
    return false;
  const double reference = problem.reference(Chart::finite);
  const std::vector<InvariantPair> starts = corrections.starts();
  if (problem.route == ModeRoute::symmetric) {
    point.symmetric =
        correct_symmetric(corrections.finite(), starts, reference, problem.corrector, counts, point.pairs);
  }
  if (point.symmetric) return true;
  point.all = correct_all(corrections.finite(), starts, reference, problem.corrector, counts, point.pairs);
  return point.all != nullptr;
}

}  // namespace

void correct_modes(const PathProblem& problem, const Prediction& prediction, PathPoint& point,
                   RunCounts& counts) {
  const StageTimer timer(counts.modes_seconds);
  ModeCorrections corrections(problem, prediction, point);
  if (correct_together(problem, prediction, corrections, point, counts.modes)) return;
  point.pairs.assign(prediction.pairs.size(), {});
  for_every_mode(problem, point.pairs.size(), point.pencil.size(), counts.modes,
                 [&](std::size_t i, ModeCounts& own) { corrections.correct(i, own); });
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    if (point.pairs[i].status == PairStatus::converged) continue;
    point.status = PointStatus::mode_lost;
    point.lost_track = static_cast<int>(i);
    point.message = "the corrector did not converge";
    return;
  }
}

namespace {

/// Series of T Z, with each product of a real and a complex matrix as a real product; see `multiply`.
std::vector<ComplexMatrix> multiply_series_by_columns(const MatrixSeries& T,
                                                      const std::vector<ComplexMatrix>& Z) {
  std::vector<ComplexMatrix> V(Z.size(), ComplexMatrix::Zero(T[0].rows(), Z[0].cols()));
  if (const auto sparse = mostly_zero(T)) {
    for (std::size_t i = 0; i < T.size(); ++i) {
      for (std::size_t j = 0; i + j < V.size(); ++j) V[i + j] += (*sparse)[i] * Z[j];
    }
    return V;
  }
  for (std::size_t i = 0; i < T.size(); ++i) {
    for (std::size_t j = 0; i + j < V.size(); ++j) V[i + j] += multiply(T[i], Z[j]);
  }
  return V;
}

/// Series of V = T Z from the series of Z, reduced vectors of a part.
std::vector<ComplexMatrix> physical_series(const PathNode& node, std::vector<ComplexMatrix> Z, int part) {
  const TangentBasis& basis = node.basis;
  if (basis.is_identity) return Z;
  if (basis.parts && basis.T.size() == 1) {
    for (ComplexMatrix& coefficient : Z) coefficient = basis.shapes(coefficient, part);
    return Z;
  }
  // For a large model, a complex copy of the basis for every mode would take longer than the product.
  if (node.linearization.K[0].is_sparse()) return multiply_series_by_columns(basis.T, Z);
  std::vector<ComplexMatrix> T;
  for (const Matrix& coefficient : basis.T) {
    if (!basis.parts) {
      T.emplace_back(coefficient.cast<Complex>());
      continue;
    }
    const IndependentParts::Range& range = basis.parts->ranges[static_cast<std::size_t>(part)];
    T.emplace_back(coefficient.middleCols(range.first, range.size).cast<Complex>());
  }
  return multiply_series(T, Z, Z.size());
}

/// The track of a corrected pair, from its series in physical coordinates. No mode numbers yet.
Track make_track(InvariantPair pair, PairSeries series) {
  Track track;
  track.pair = std::move(pair);
  track.functions = block_functions(series.Lambda);
  track.roots = pair_eigenvalues(track.pair);
  track.modes.assign(static_cast<std::size_t>(track.size()), Track::no_mode);
  track.series = std::move(series);
  return track;
}

Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          ModeCounts& counts) {
  PairSeries series = differentiate_pair(node.pencil.of(pair.part), pair, problem.order + 1, counts,
                                         problem.corrector.series_accuracy);
  series.Z = physical_series(node, std::move(series.Z), pair.part);
  return make_track(std::move(pair), std::move(series));
}

/// The track of pair i of a point: from an earlier computation, as extrapolated, or differentiated now.
Track track_at(const PathProblem& problem, const PathNode& node, const PathPoint& point, std::size_t i,
               ModeCounts& counts) {
  if (i < point.ready.size() && point.ready[i] != nullptr) {
    Track track = make_track(point.ready[i]->pair, point.ready[i]->series);
    track.passed = point.ready[i]->passed;
    return track;
  }
  if (i >= point.passed.size() || !point.passed[i])
    return differentiate_track(problem, node, point.pairs[i], counts);
  Track track = make_track(point.pairs[i], *point.passed[i]);
  track.passed = true;
  return track;
}

}  // namespace

Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts) {
  return differentiate_track(problem, node, std::move(pair), counts.modes);
}

std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts) {
  const int order = problem.order + 1;
  std::vector<Track> tracks(point.pairs.size());
  if (!point.symmetric && !point.all) {
    for_every_mode(
        problem, tracks.size(), node.pencil.size(), counts.modes,
        [&](std::size_t i, ModeCounts& own) { tracks[i] = track_at(problem, node, point, i, own); });
    return tracks;
  }
  std::vector<PairSeries> series =
      point.symmetric ? differentiate_symmetric(node.pencil, *point.symmetric, order, counts.modes)
                      : differentiate_all(node.pencil, *point.all, order, problem.corrector.series_accuracy,
                                          counts.modes);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    series[i].Z = physical_series(node, std::move(series[i].Z), point.pairs[i].part);
    tracks[i] = make_track(point.pairs[i], std::move(series[i]));
  }
  return tracks;
}

}  // namespace eigentrail
