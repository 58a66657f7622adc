#include "continuation/step/modal_certificate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "continuation/step/modal_bounds.hpp"
#include "continuation/step/shared_basis.hpp"
#include "core/matrix_series.hpp"

namespace eigentrail {
namespace {

/// A step is halved up to this often: one basis serves all modes, so that more halvings cost less here.
constexpr int modal_max_depth = 6;
/// As in certificate.cpp: halving is given up for a track whose Z1 >= 1 does not decrease to this share.
constexpr double modal_falling = 0.75;
/// Largest rounding error of modal coordinates: the reciprocal condition of the basis is then 1e-4. In a
/// worse one vectors are nearly parallel. Each mode can still be told from the others in its own norm, but
/// not much farther on all of them meet, and a block of some of them no longer converges there. With a larger
/// value they go on apart for longer, with a smaller one more of them are tested one by one.
constexpr double most_parallel = 2e-11;

/// Multiplications per piece, in cubes of the size of the basis: one inverse and the products at five places.
/// Only the budget of the certificate depends on it.
constexpr double work_of_piece = 6.0;
/// In place of infinity, so that products with zero are numbers.
constexpr double beyond_all = 1e100;

/// The coefficients of the series of a complex matrix at the left end of a step, then at the right end.
class StepSeries {
 public:
  StepSeries() = default;
  StepSeries(Eigen::Index rows, Eigen::Index columns, Eigen::Index count)
      : rows_(rows), columns_(columns), values_(ComplexMatrix::Zero(rows * columns, 2 * count)) {}

  /// Writes columns of a coefficient, those of a track, from the top row on.
  void set(Eigen::Index coefficient, Eigen::Index column, const ComplexMatrix& block) {
    auto matrix = values_.col(coefficient).reshaped(rows_, columns_);
    matrix.block(0, column, block.rows(), block.cols()) = block;
  }

  /// The sum of all coefficients with real weights, by one real product.
  ComplexMatrix sum(const Vector& weights) const {
    ComplexMatrix result(rows_, columns_);
    // std::complex<double> can be read as an array of two doubles ([complex.numbers]).
    const auto* const parts = reinterpret_cast<const double*>(values_.data());
    const Eigen::Map<const Matrix> coefficients(parts, 2 * values_.rows(), values_.cols());
    Eigen::Map<Vector>(reinterpret_cast<double*>(result.data()), 2 * result.size()).noalias() =
        coefficients * weights.head(values_.cols());
    return result;
  }

 private:
  Eigen::Index rows_ = 0, columns_ = 0;
  ComplexMatrix values_;  ///< one coefficient per column, column by column
};

/// Whether tracks are a basis of the state space of a pencil with the leading matrix M.
bool are_basis(const std::vector<const Track*>& tracks, const Matrix& M) {
  Eigen::Index columns = 0;
  for (const Track* track : tracks) columns += track->size() * (track->pair.is_real ? 1 : 2);
  return columns == state_size(M);
}

/// Series of a track at one end of the step, in the normalization W and in the finite chart.
PairSeries in_finite_chart(const Track& track, const PathNode& left, const ComplexMatrix& W) {
  PairSeries series{in_basis_of(left, track.series.Z, track.pair.part), track.series.Lambda};
  fix_basis(W, series.Z, series.Lambda);
  if (track.pair.chart == Chart::reciprocal) series.Lambda = inverse_series(series.Lambda);
  return series;
}

/// The certificates of all tracks of one part on one step.
class ModalBallTest {
 public:
  /// `left` and `right` are the tracks of the part, at both ends.
  ModalBallTest(const StepPencil& pencil, const std::vector<const Track*>& left,
                const std::vector<const Track*>& right, RunCounts& counts)
      : pencil_(pencil), counts_(counts) {
    Eigen::Index columns = 0, largest = 1;
    for (const Track* track : left) {
      places_.push_back({columns, track->size(), track->pair.is_real});
      columns += track->size();
      largest = std::max(largest, track->size());
    }
    const auto count = static_cast<Eigen::Index>(left.front()->series.Z.size());
    Z_ = StepSeries(left.front()->pair.Z.rows(), columns, count);
    Lambda_ = StepSeries(largest, columns, count);
    for (std::size_t i = 0; i < left.size(); ++i) {
      const ComplexMatrix& W = left[i]->pair.W;
      for (const bool at_end : {false, true}) {
        const PairSeries series = in_finite_chart(*(at_end ? right : left)[i], pencil.left(), W);
        for (Eigen::Index j = 0; j < count; ++j) {
          const Eigen::Index coefficient = at_end ? count + j : j;
          Z_.set(coefficient, places_[i].first, series.Z[static_cast<std::size_t>(j)]);
          Lambda_.set(coefficient, places_[i].first, series.Lambda[static_cast<std::size_t>(j)]);
        }
      }
    }
  }

  /// Per track, whether its test closes.
  std::vector<bool> closes() {
    const std::vector<bool> wanted(places_.size(), true);
    std::vector<bool> closed = wanted;
    close(0.0, 1.0, 0, wanted, std::vector<double>(wanted.size(), INFINITY), closed);
    return closed;
  }

 private:
  /// The interpolated pairs at a sample.
  PairSet at(const StepPencil::Sample& sample) const {
    return {places_, Z_.sum(sample.weights), Lambda_.sum(sample.weights), {}};
  }

  /// Tests the tracks in `wanted` between `begin` and `end`, with halvings, and sets `closed` to false for
  /// those whose test does not close. `last` holds Z1 of the piece that was halved into this one and another.
  void close(double begin, double end, int depth, const std::vector<bool>& wanted,
             const std::vector<double>& last, std::vector<bool>& closed) {
    const double middle = 0.5 * (begin + end);
    std::vector<double> Z1(wanted.size(), INFINITY);
    const std::vector<bool> here = piece(begin, middle, end, wanted, Z1);
    std::vector<bool> open = wanted;
    bool is_done = true;
    for (std::size_t i = 0; i < open.size(); ++i) {
      open[i] = wanted[i] && closed[i] && !here[i];
      // Z1 decreases at best in proportion to the length of the piece.
      const bool is_hopeless = !(Z1[i] < std::exp2(modal_max_depth - depth)) ||
                               (Z1[i] >= 1.0 && !(Z1[i] <= modal_falling * last[i])) ||
                               depth == modal_max_depth;
      if (open[i] && is_hopeless) open[i] = closed[i] = false;
      is_done = is_done && !open[i];
    }
    if (is_done) return;
    close(begin, middle, depth + 1, open, Z1, closed);
    close(middle, end, depth + 1, open, Z1, closed);
  }

  /// Per track in `wanted`, whether its test closes on one piece, without halving. Sets Z1.
  std::vector<bool> piece(double begin, double middle, double end, const std::vector<bool>& wanted,
                          std::vector<double>& Z1) {
    std::vector<bool> result(places_.size(), false);
    const Sampled centre = sampled_at(middle, nullptr);
    if (!pencil_.has_constant_leading_matrix()) leading_inverse_.reset();
    const auto basis = ModalBasis::from(centre.sample->at, centre.set, leading_inverse_);
    count(static_cast<double>(state_size(centre.sample->at.M)));
    if (!basis || basis->rounding() > most_parallel) return result;
    const ComplexMatrix at_middle = residual(centre.sample->at, centre.set);
    std::vector<ModalSample> samples;
    for (const double t : {begin, end, 0.5 * (begin + middle), middle, 0.5 * (middle + end)})
      samples.push_back(modal_sample(*basis, centre, at_middle, sampled_at(t, centre.sample.get())));
    Vector sizes(static_cast<Eigen::Index>(places_.size()));
    for (std::size_t i = 0; i < places_.size(); ++i)
      sizes[static_cast<Eigen::Index>(i)] = centre.set.block(centre.set.Lambda, places_[i]).norm();
    const ModalPlaces places(places_, *basis);
    const Matrix distances = inverse_distances(*basis, centre.set, wanted);
    const ModalBounds bounds(places, samples, distances, sizes);
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (!wanted[i]) continue;
      const ModalBounds::Result of_track = bounds.of_track(i);
      result[i] = of_track.closes;
      Z1[i] = of_track.Z1;
    }
    return result;
  }

  void count(double size) {
    ++counts_.certificate_bases;
    counts_.certificate_work += work_of_piece * size * size * size;
  }

  /// Norms of the inverses of X -> D_a X - X Lambda_b, for every row of the coordinates, which belongs to a
  /// pair a or to its conjugate, and every track b in `wanted`: 1 / |s_a - s_b| of two single modes. Zero for
  /// a = b.
  Matrix inverse_distances(const ModalBasis& basis, const PairSet& set,
                           const std::vector<bool>& wanted) const {
    Matrix inverse = Matrix::Zero(basis.size(), static_cast<Eigen::Index>(places_.size()));
    std::vector<ComplexMatrix> own, conjugate;
    for (const PairSet::Place& place : places_) {
      own.push_back(set.block(set.Lambda, place));
      conjugate.push_back(own.back().conjugate());
    }
    for (std::size_t b = 0; b < places_.size(); ++b) {
      if (!wanted[b]) continue;
      auto column = inverse.col(static_cast<Eigen::Index>(b));
      for (std::size_t a = 0; a < places_.size(); ++a) {
        const PairSet::Place& place = places_[a];
        if (a != b) column.segment(place.first, place.size).setConstant(inverse_distance(own[a], own[b]));
        if (place.is_real) continue;
        column.segment(basis.conjugate_row(place.first), place.size)
            .setConstant(inverse_distance(conjugate[a], own[b]));
      }
    }
    return inverse;
  }

  /// The interpolated pencil and pairs at a sample point.
  struct Sampled {
    std::shared_ptr<const StepPencil::Sample> sample;
    PairSet set;
    /// Leading matrix at the middle times its inverse at this point; empty if it is constant.
    Matrix from_leading;
  };

  /// The sample at t. `middle` is the one at the middle of the piece; null for that one itself.
  Sampled sampled_at(double t, const StepPencil::Sample* middle) const {
    const auto sample = pencil_.at(t);
    if (middle == nullptr || pencil_.has_constant_leading_matrix()) return {sample, at(*sample), Matrix()};
    const auto leading = [](const PencilAtPoint& pencil) { return leading_matrix(pencil.M, pencil.C); };
    return {sample, at(*sample), leading(middle->at) * leading(sample->at).partialPivLu().inverse()};
  }

  /// Residuals with the pencil at a sample point, of the pairs at the middle and of those there, in modal
  /// coordinates of the companion form. `at_middle`: residuals of the pairs at the middle with the pencil
  /// there; only what is not constant in the pencil changes them.
  static ModalSample modal_sample(const ModalBasis& basis, const Sampled& centre,
                                  const ComplexMatrix& at_middle, const Sampled& there) {
    const auto modal = [&](const ComplexMatrix& R) {
      return basis.coordinates(there.from_leading.size() == 0 ? R : multiply_many(there.from_leading, R));
    };
    ComplexMatrix change = there.set.Lambda - centre.set.Lambda;
    if (there.sample == centre.sample) {
      const ComplexMatrix defect = modal(at_middle);
      return {-defect, defect, std::move(change)};
    }
    const PencilAtPoint &from = centre.sample->at, &to = there.sample->at;
    const ComplexMatrix moved = at_middle + residual(to.M - from.M, to.C - from.C, to.K - from.K, centre.set);
    return {-modal(moved), modal(residual(to, there.set)), std::move(change)};
  }

  const StepPencil& pencil_;
  RunCounts& counts_;
  std::vector<PairSet::Place> places_;
  StepSeries Z_, Lambda_;                  ///< of all tracks, as in PairSet
  std::optional<Matrix> leading_inverse_;  ///< of the last basis
};

}  // namespace

double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B) {
  if (A.size() == 1 && B.size() == 1) return std::min(1.0 / std::abs(A(0) - B(0)), beyond_all);
  const ComplexMatrix inverse = inverse_sylvester(A, B);
  if (!(inverse.norm() < beyond_all)) return beyond_all;
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(inverse.adjoint() * inverse),
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(squares.eigenvalues().maxCoeff());
}

std::vector<bool> certify_all(const StepPencil& pencil, const PathNode& right, int part, RunCounts& counts) {
  const std::vector<Track>& tracks = pencil.left().tracks;
  std::vector<bool> closed(tracks.size(), false);
  std::vector<std::size_t> own;
  std::vector<const Track*> at_left, at_right;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].pair.part != part) continue;
    own.push_back(i);
    at_left.push_back(&tracks[i]);
    at_right.push_back(&right.tracks[i]);
  }
  // Of a complex part, the conjugates are modes of another one.
  if (pencil.left().pencil.of(part).complex_sign != 0) return closed;
  if (own.empty() || !are_basis(at_left, pencil.left().pencil.of(part).M[0])) return closed;
  const std::vector<bool> of_part = ModalBallTest(pencil, at_left, at_right, counts).closes();
  for (std::size_t i = 0; i < own.size(); ++i) closed[own[i]] = of_part[i];
  return closed;
}

}  // namespace eigentrail
