#include "continuation/step/modal_certificate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "continuation/step/jacobian_change.hpp"
#include "continuation/step/shared_basis.hpp"
#include "modes/pair_set.hpp"

namespace eigentrail {
namespace {

/// A step is halved up to this often. Modes that fail then are tested one by one, which halves up to 6 times.
constexpr int max_depth = 3;
/// As in certificate.cpp: halving is given up for a mode whose Z1 >= 1 does not decrease to this share.
constexpr double falling = 0.75;
/// As in certificate.cpp: factor on Z2, which is evaluated at the middle of a piece only.
constexpr double curvature_safety = 1.5;
/// If only this many modes are left uncertified, they are tested one by one: that costs less than another
/// basis for all. Affects only the time.
constexpr std::size_t few = 3;

/// Writes a matrix of one track into the columns of that track.
void append(const ComplexMatrix& block, const PairSet::Place& place, ComplexMatrix& blocks) {
  blocks.block(0, place.first, block.rows(), block.cols()) = block;
}

/// Whether the tracks of a point are a basis of the state space, all in the finite chart.
bool is_basis(const PathNode& node) {
  Eigen::Index columns = 0;
  for (const Track& track : node.tracks) {
    if (track.pair.chart != Chart::finite) return false;
    columns += track.size() * (track.pair.is_real ? 1 : 2);
  }
  return columns == state_size(node.pencil.M[0]);
}

/// The certificates of all tracks on one step.
class ModalTube {
 public:
  ModalTube(const StepPencil& pencil, const PathNode& right, RunCounts& counts)
      : pencil_(pencil), counts_(counts) {
    const std::vector<Track>& tracks = pencil.left().tracks;
    Eigen::Index columns = 0, largest = 1;
    for (const Track& track : tracks) {
      places_.push_back({columns, track.size(), track.pair.is_real});
      columns += track.size();
      largest = std::max(largest, track.size());
    }
    const std::size_t count = tracks.front().series.Z.size();
    const Eigen::Index n = tracks.front().pair.Z.rows();
    for (auto* ends : {&Z_, &Lambda_})
      ends->assign(2 * count, ComplexMatrix::Zero(ends == &Z_ ? n : largest, columns));
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      std::vector<ComplexMatrix> Z = in_basis_of(pencil.left(), right.tracks[i].series.Z);
      std::vector<ComplexMatrix> Lambda = right.tracks[i].series.Lambda;
      fix_basis(tracks[i].pair.W, Z, Lambda);
      const std::vector<ComplexMatrix> left_Z = in_basis_of(pencil.left(), tracks[i].series.Z);
      for (std::size_t j = 0; j < count; ++j) {
        append(left_Z[j], places_[i], Z_[j]);
        append(tracks[i].series.Lambda[j], places_[i], Lambda_[j]);
        append(Z[j], places_[i], Z_[count + j]);
        append(Lambda[j], places_[i], Lambda_[count + j]);
      }
    }
  }

  /// Per track, whether its tube closes; blocks of more than one are not tested.
  std::vector<bool> closes() {
    std::vector<bool> wanted(places_.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = places_[i].size == 1;
    std::vector<bool> closed = wanted;
    close(0.0, 1.0, 0, wanted, std::vector<double>(wanted.size(), INFINITY), closed);
    return closed;
  }

 private:
  /// The interpolated pairs at a sample.
  PairSet at(const StepPencil::Sample& sample) const {
    PairSet set{places_,
                ComplexMatrix::Zero(Z_[0].rows(), Z_[0].cols()),
                ComplexMatrix::Zero(Lambda_[0].rows(), Lambda_[0].cols()),
                {}};
    for (std::size_t i = 0; i < Z_.size(); ++i) {
      const double weight = sample.weights[static_cast<Eigen::Index>(i)];
      set.Z += weight * Z_[i];
      set.Lambda += weight * Lambda_[i];
    }
    return set;
  }

  /// Tests the tracks in `wanted` between `begin` and `end`, with halvings, and sets `closed` to false for
  /// those whose tube does not close. `last` holds Z1 of the piece that was halved into this one and another.
  void close(double begin, double end, int depth, const std::vector<bool>& wanted,
             const std::vector<double>& last, std::vector<bool>& closed) {
    const double middle = 0.5 * (begin + end);
    std::vector<double> Z1(wanted.size(), INFINITY);
    const std::vector<bool> here = piece(begin, middle, end, Z1);
    std::vector<bool> open = wanted;
    std::size_t left = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      open[i] = wanted[i] && closed[i] && !here[i];
      if (open[i] && Z1[i] >= 1.0 && !(Z1[i] <= falling * last[i])) open[i] = closed[i] = false;
      left += open[i] ? 1 : 0;
    }
    if (left == 0) return;
    if (depth == max_depth || left <= few) {
      for (std::size_t i = 0; i < open.size(); ++i) closed[i] = closed[i] && !open[i];
      return;
    }
    close(begin, middle, depth + 1, open, Z1, closed);
    close(middle, end, depth + 1, open, Z1, closed);
  }

  /// Per track, whether its tube closes on one piece, without halving. Sets Z1.
  std::vector<bool> piece(double begin, double middle, double end, std::vector<double>& Z1) {
    std::vector<bool> result(places_.size(), false);
    const Sampled centre = sampled_at(middle, nullptr);
    const PairSet& set = centre.set;
    const auto basis = ModalBasis::from(centre.sample->at, set);
    ++counts_.certificate_bases;
    if (!basis) return result;
    const Matrix weights = distances(*basis, set).cwiseInverse();
    Vector Y = defect(*basis, centre, weights);
    Z1.assign(places_.size(), 0.0);
    for (const double t : {begin, 0.5 * (begin + middle), 0.5 * (middle + end), end}) {
      const Sampled there = sampled_at(t, centre.sample.get());
      Y = Y.cwiseMax(defect(*basis, there, weights));
      const Vector bounds = change(*basis, there, set, weights);
      for (std::size_t i = 0; i < Z1.size(); ++i) Z1[i] = std::max(Z1[i], bounds[places_[i].first]);
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Eigen::Index b = places_[i].first;
      const double Z2 = curvature_safety * 2.0 * scale(weights, set, b) * weights.col(b).maxCoeff();
      const double room = 1.0 - Z1[i];
      result[i] = places_[i].size == 1 && Z1[i] < 1.0 && room * room > 2.0 * Z2 * Y[b];
    }
    return result;
  }

  /// Distances |s_b - s_a| of the single mode in column b from the mode in row a; infinite for a = b. If a
  /// belongs to a block, 1 / |(Lambda_a - s_b I)^-1|.
  Matrix distances(const ModalBasis& basis, const PairSet& set) const {
    Matrix d = Matrix::Constant(basis.size(), set.Z.cols(), INFINITY);
    for (const PairSet::Place& b : places_) {
      if (b.size > 1) continue;
      const Complex s = set.Lambda(0, b.first);
      for (const PairSet::Place& a : places_) {
        const bool itself = a.first == b.first;
        if (a.size == 1) {
          const Complex other = set.Lambda(0, a.first);
          if (!itself) d(a.first, b.first) = std::abs(s - other);
          if (!a.is_real) d(basis.conjugate_row(a.first), b.first) = std::abs(s - std::conj(other));
          continue;
        }
        const ComplexMatrix L = set.block(set.Lambda, a);
        const ComplexMatrix I = ComplexMatrix::Identity(a.size, a.size);
        const auto fill = [&](Eigen::Index row, const ComplexMatrix& block) {
          d.col(b.first).segment(row, a.size).setConstant(1.0 / (block - s * I).inverse().norm());
        };
        fill(a.first, L);
        if (!a.is_real) fill(basis.conjugate_row(a.first), L.conjugate());
      }
    }
    return d;
  }

  /// `scale` of the unknowns (vec Z, s / scale) of a mode, about half the distance to the nearest other one.
  static double scale(const Matrix& weights, const PairSet& set, Eigen::Index b) {
    return unknown_scale(1.0 / weights.col(b).maxCoeff(), std::abs(set.Lambda(0, b)));
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

  /// Residuals of pairs with the pencil at a sample point, in modal coordinates of the companion form.
  static ComplexMatrix modal_residual(const ModalBasis& basis, const Sampled& place, const PairSet& set) {
    const PencilAtPoint& pencil = place.sample->at;
    const ComplexMatrix R = residual(pencil.M, pencil.C, pencil.K, set);
    return basis.coordinates(place.from_leading.size() == 0 ? R : multiply_many(place.from_leading, R));
  }

  /// Y of every mode.
  static Vector defect(const ModalBasis& basis, const Sampled& there, const Matrix& weights) {
    const PairSet& moved = there.set;
    const ComplexMatrix F = modal_residual(basis, there, moved);
    Vector Y(F.cols());
    for (Eigen::Index b = 0; b < F.cols(); ++b) {
      const double kappa = scale(weights, moved, b);
      const double others = weights.col(b).cwiseAbs2().dot(F.col(b).cwiseAbs2());
      Y[b] = std::sqrt(others + std::norm(F(b, b)) / (kappa * kappa));
    }
    return Y;
  }

  /// Z1 of every mode. The Jacobian at a sample differs from that at the middle by E(t), by the change of the
  /// eigenvalue, and by the change of the vector.
  Vector change(const ModalBasis& basis, const Sampled& there, const PairSet& set,
                const Matrix& weights) const {
    const PairSet& moved = there.set;
    // -E(t), without the columns of the conjugates.
    const ComplexMatrix E = modal_residual(basis, there, set);
    const Eigen::Index columns = E.cols();
    const Vector own = E.rowwise().squaredNorm();
    Vector paired = Vector::Zero(E.rows());  // the same over the columns that have conjugates
    for (Eigen::Index c = 0; c < columns; ++c) {
      if (basis.conjugate_row(c) >= 0) paired += E.col(c).cwiseAbs2();
    }
    // In a row, the columns of the conjugates hold the conjugates of the entries in the conjugate row.
    Vector rows = own + paired;
    ComplexVector diagonal(E.rows());
    for (Eigen::Index c = 0; c < columns; ++c) {
      const Eigen::Index conjugate = basis.conjugate_row(c);
      diagonal[c] = -E(c, c);
      if (conjugate < 0) continue;
      rows[c] = own[c] + paired[conjugate];
      rows[conjugate] = own[conjugate] + paired[c];
      diagonal[conjugate] = -std::conj(E(c, c));
    }
    Vector Z1 = Vector::Constant(columns, INFINITY);
    for (const PairSet::Place& place : places_) {
      if (place.size > 1) continue;
      const Eigen::Index b = place.first;
      const double kappa = scale(weights, moved, b);
      const Complex shift = moved.Lambda(0, b) - set.Lambda(0, b);
      const auto w2 = weights.col(b).array().square();
      const auto coupling = E.col(b).cwiseAbs2().array();
      const auto entries = rows.array() - coupling - diagonal.array().abs2() +
                           (diagonal.array() - shift).abs2() + kappa * kappa * w2 * coupling;
      const double others = (w2 > 0.0).select(w2 * entries.max(0.0), 0.0).sum();
      Z1[b] = std::sqrt(others + (rows[b] - std::norm(E(b, b))) / (kappa * kappa));
    }
    return Z1;
  }

  const StepPencil& pencil_;
  RunCounts& counts_;
  std::vector<PairSet::Place> places_;
  std::vector<ComplexMatrix> Z_, Lambda_;  ///< series of all tracks: at the left end, then at the right end
};

}  // namespace

std::vector<bool> certify_all(const StepPencil& pencil, const PathNode& right, RunCounts& counts) {
  if (!is_basis(pencil.left())) return std::vector<bool>(right.tracks.size(), false);
  return ModalTube(pencil, right, counts).closes();
}

}  // namespace eigentrail
