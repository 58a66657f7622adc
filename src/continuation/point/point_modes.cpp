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
  }

  /// Sets pair i.
  void correct(std::size_t i, ModeCounts& counts) {
    const InvariantPair start = reduced(prediction_.pairs[i]);
    const PencilAtPoint& pencil =
        (start.chart == Chart::finite ? finite_ : reciprocal_)[static_cast<std::size_t>(start.part)];
    point_.pairs[i] =
        correct_pair(pencil, start, problem_.reference(start.chart), problem_.corrector, counts);
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

/// Series of V = T Z at a node from the series of Z, reduced vectors of a part.
class PhysicalSeries {
 public:
  explicit PhysicalSeries(const PathNode& node) : basis_(node.basis) {
    // Of parts only some columns are used.
    is_large_ = !basis_.is_identity && !basis_.parts && node.linearization.K[0].is_sparse();
    if (is_large_) sparse_ = mostly_zero(basis_.T);
  }

  std::vector<ComplexMatrix> operator()(std::vector<ComplexMatrix> Z, int part) const {
    if (basis_.is_identity) return Z;
    if (basis_.parts && basis_.T.size() == 1) {
      for (ComplexMatrix& coefficient : Z) coefficient = basis_.shapes(coefficient, part);
      return Z;
    }
    if (is_large_) return of_large(Z);
    std::vector<ComplexMatrix> T;
    for (const Matrix& coefficient : basis_.T) {
      if (!basis_.parts) {
        T.emplace_back(coefficient.cast<Complex>());
        continue;
      }
      const IndependentParts::Range& range = basis_.parts->ranges[static_cast<std::size_t>(part)];
      T.emplace_back(coefficient.middleCols(range.first, range.size).cast<Complex>());
    }
    return multiply_series(T, Z, Z.size());
  }

 private:
  /// For a large model, a complex copy of the basis for every mode would take longer than the product.
  std::vector<ComplexMatrix> of_large(const std::vector<ComplexMatrix>& Z) const {
    std::vector<ComplexMatrix> V(Z.size(), ComplexMatrix::Zero(basis_.T[0].rows(), Z[0].cols()));
    for (std::size_t i = 0; i < basis_.T.size(); ++i) {
      for (std::size_t j = 0; i + j < V.size(); ++j) {
        if (sparse_) {
          V[i + j] += (*sparse_)[i] * Z[j];
        } else {
          V[i + j] += multiply(basis_.T[i], Z[j]);
        }
      }
    }
    return V;
  }

  const TangentBasis& basis_;
  bool is_large_ = false;
  std::optional<SparseSeries> sparse_;  ///< of a large model, where most entries are zero
};

/// Removes what rounding leaves of the real part of one eigenvalue, or of the mean of two and of the
/// imaginary part of their discriminant, where the spectrum is symmetric about the imaginary axis. A larger
/// real part is of members whose mirror images are not in the block.
void settle_on_axis(double rounding, Track& track) {
  const Eigen::Index k = track.size();
  if (k > 2 || std::abs(track.functions(0, 0).real()) > rounding) return;
  const bool is_delta_real =
      k == 1 || std::abs(track.functions(1, 0).imag()) <= function_rounding(track.pair.Lambda, rounding)[1];
  if (!is_delta_real) return;
  for (Eigen::Index j = 0; j < track.functions.cols(); ++j)
    track.series.Lambda[static_cast<std::size_t>(j)].diagonal().array() -= track.functions(0, j).real();
  track.pair.Lambda.diagonal().array() -= track.functions(0, 0).real();
  track.functions.row(0).real().setZero();
  if (k == 2) track.functions.row(1).imag().setZero();
  track.roots = in_order_of(track.roots, block_roots(track.functions.col(0)));
}

/// The track of a corrected pair, from its series in physical coordinates. No mode numbers yet.
Track make_track(const PathProblem& problem, InvariantPair pair, PairSeries series) {
  Track track;
  track.pair = std::move(pair);
  track.functions = block_functions(series.Lambda);
  track.roots = pair_eigenvalues(track.pair);
  // Of two that are one, rounding makes two that differ by its root.
  const bool are_one = track.size() == 2 && track.functions.row(1).isZero(0.0);
  if (are_one) track.roots.setConstant(track.functions(0, 0));
  track.modes.assign(static_cast<std::size_t>(track.size()), Track::no_mode);
  track.series = std::move(series);
  if (problem.structure.reflects_spectrum())
    settle_on_axis(problem.thresholds.rounding.entries * track.pair.rounding, track);
  return track;
}

Track differentiate_track(const PathProblem& problem, const PathNode& node, const PhysicalSeries& physical,
                          InvariantPair pair, ModeCounts& counts) {
  PairSeries series = differentiate_pair(node.pencil.of(pair.part), pair, problem.order + 1, counts,
                                         problem.corrector.series_accuracy);
  series.Z = physical(std::move(series.Z), pair.part);
  return make_track(problem, std::move(pair), std::move(series));
}

}  // namespace

Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts) {
  return differentiate_track(problem, node, PhysicalSeries(node), std::move(pair), counts.modes);
}

std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts) {
  const int order = problem.order + 1;
  std::vector<Track> tracks(point.pairs.size());
  const PhysicalSeries physical(node);
  if (!point.symmetric && !point.all) {
    for_every_mode(problem, tracks.size(), node.pencil.size(), counts.modes,
                   [&](std::size_t i, ModeCounts& own) {
                     tracks[i] = differentiate_track(problem, node, physical, point.pairs[i], own);
                   });
    return tracks;
  }
  std::vector<PairSeries> series =
      point.symmetric ? differentiate_symmetric(node.pencil, *point.symmetric, order, counts.modes)
                      : differentiate_all(node.pencil, *point.all, order, problem.corrector.series_accuracy,
                                          counts.modes);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    series[i].Z = physical(std::move(series[i].Z), point.pairs[i].part);
    tracks[i] = make_track(problem, point.pairs[i], std::move(series[i]));
  }
  return tracks;
}

}  // namespace eigentrail
