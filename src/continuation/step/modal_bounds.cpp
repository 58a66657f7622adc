#include "continuation/step/modal_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/step/ball_norm.hpp"
#include "continuation/step/jacobian_change.hpp"

namespace eigentrail {
namespace {

/// As in certificate.cpp: factor on Z2, which is evaluated at the middle of a piece only.
constexpr double bound_curvature_safety = 1.5;
/// Sweeps of the balancing; more change the bounds by a few per cent.
constexpr int bound_sweeps = 2;

}  // namespace

ModalPlaces::ModalPlaces(std::vector<PairSet::Place> of_tracks, const ModalBasis& basis)
    : places(std::move(of_tracks)), conjugate_row(static_cast<std::size_t>(basis.size())) {
  for (const PairSet::Place& place : places) {
    for (Eigen::Index i = place.first; i < place.first + place.size; ++i) {
      const Eigen::Index other = place.is_real ? i : basis.conjugate_row(i);
      conjugate_row[static_cast<std::size_t>(i)] = other;
      conjugate_row[static_cast<std::size_t>(other)] = i;
    }
  }
}

/// Squares of the parts of Y and Z1 of a track.
struct ModalBounds::Sums {
  double defect = 0.0, own_defect = 0.0;  ///< of Y, in the rows of the others and in the own ones
  double within = 0.0;                    ///< of Z1, from the vectors to the vectors
  double to_Lambda = 0.0, from_Lambda = 0.0;
  double beside_shift = 0.0;  ///< norm of the change of Lambda beside a multiple of the identity

  void enlarge(const Sums& other) {
    defect = std::max(defect, other.defect);
    own_defect = std::max(own_defect, other.own_defect);
    within = std::max(within, other.within);
    to_Lambda = std::max(to_Lambda, other.to_Lambda);
    from_Lambda = std::max(from_Lambda, other.from_Lambda);
    beside_shift = std::max(beside_shift, other.beside_shift);
  }

  /// Bounds the change of the vectors, of which the first term of a series is known, by the whole series.
  void complete_vectors() {
    const double series = 1.0 / std::max(1.0 - std::sqrt(within), 0.0);
    from_Lambda *= series * series;
    beside_shift *= series;
  }

  double Y(double kappa) const { return std::sqrt(defect + own_defect / (kappa * kappa)); }
  double Z1(double kappa, double nearest) const {
    const double square = kappa * kappa;
    return std::sqrt(within + to_Lambda / square + square * from_Lambda) + nearest * beside_shift;
  }
};

ModalBounds::ModalBounds(const ModalPlaces& places, const std::vector<ModalSample>& samples,
                         const Matrix& inverse_distances, const Vector& sizes)
    : places_(places), samples_(samples), inverse_distances_(inverse_distances), sizes_(sizes) {
  for (const ModalSample& sample : samples) {
    const Matrix squares = sample.E.cwiseAbs2();
    const Matrix conjugates = squares(places.conjugate_row, Eigen::all);
    Matrix norms(places.rows(), static_cast<Eigen::Index>(places.places.size()));
    for (std::size_t c = 0; c < places.places.size(); ++c) {
      const auto& [first, size, is_real] = places.places[c];
      auto column = norms.col(static_cast<Eigen::Index>(c));
      column = squares.middleCols(first, size).rowwise().sum();
      // In a row, the columns of the conjugates hold the conjugates of the entries in the conjugate row.
      if (!is_real) column += conjugates.middleCols(first, size).rowwise().sum();
    }
    norms_.push_back(std::move(norms));
  }
}

/// For every row, the scale of its track.
Vector ModalBounds::balancing_scales(std::size_t track) const {
  const auto weights = inverse_distances_.col(static_cast<Eigen::Index>(track)).cwiseAbs2();
  const Matrix divided = weights.asDiagonal() * norms_.front();
  const auto count = static_cast<Eigen::Index>(places_.places.size());
  Matrix squares = Matrix::Zero(count, count);
  const auto rows_of = [&](std::size_t a, const auto& visit) {
    const PairSet::Place& place = places_.places[a];
    for (Eigen::Index i = place.first; i < place.first + place.size; ++i) {
      visit(i);
      if (!place.is_real) visit(places_.conjugate_row[static_cast<std::size_t>(i)]);
    }
  };
  for (std::size_t a = 0; a < places_.places.size(); ++a)
    rows_of(a, [&](Eigen::Index i) { squares.row(static_cast<Eigen::Index>(a)) += divided.row(i); });
  const Vector of_places = eigentrail::balancing_scales(std::move(squares), bound_sweeps);
  Vector scales(places_.rows());
  for (std::size_t a = 0; a < places_.places.size(); ++a)
    rows_of(a, [&](Eigen::Index i) { scales[i] = of_places[static_cast<Eigen::Index>(a)]; });
  return scales;
}

/// The Jacobian at a sample differs from that at the middle by E(t), by the change of Lambda, and by the
/// change of the vectors, which is E(t) divided by the distances to first order.
ModalBounds::Sums ModalBounds::sums(const ModalSample& sample, const Matrix& norms, std::size_t track,
                                    const Vector& scales) const {
  const auto& [first, size, is_real] = places_.places[track];
  const Eigen::ArrayXd squares = scales.array().square();
  const auto distance = inverse_distances_.col(static_cast<Eigen::Index>(track)).array();
  const Eigen::ArrayXd weights = distance.square() / squares;
  const double own_square = squares[first];

  Sums sums;
  const Eigen::ArrayXd defect = sample.defect.middleCols(first, size).rowwise().squaredNorm() * own_square;
  sums.defect = (weights * defect).sum();
  sums.own_defect = defect.segment(first, size).sum() / own_square;

  Vector of_columns(norms.cols());
  for (Eigen::Index c = 0; c < norms.cols(); ++c)
    of_columns[c] = squares[places_.places[static_cast<std::size_t>(c)].first];
  // The own columns, without their conjugates, belong to Lambda.
  const Eigen::ArrayXd column = sample.E.middleCols(first, size).rowwise().squaredNorm() * own_square;
  Eigen::ArrayXd rows = ((norms * of_columns).array() - column).max(0.0);
  sums.to_Lambda = rows.segment(first, size).sum() / own_square;
  sums.from_Lambda = (weights * distance.square() * column).sum();

  Complex shift = sample.Lambda(0, first);
  if (size > 1) {
    // In the basis in which the own part of the vectors stays the same, Lambda changes by the own part of E
    // and by what returns from the others.
    const auto own = sample.E.block(first, first, size, size);
    shift = own.trace() / static_cast<double>(size);
    const double returning = std::sqrt(sums.to_Lambda * (weights * column).sum());
    sums.beside_shift = (own - shift * ComplexMatrix::Identity(size, size)).norm() + returning;
  }
  for (Eigen::Index i = 0; i < sample.E.cols(); ++i) {
    const Eigen::Index other = places_.conjugate_row[static_cast<std::size_t>(i)];
    const Complex entry = sample.E(i, i);
    rows[i] += (std::norm(entry - shift) - std::norm(entry)) * squares[i];
    if (other != i) rows[other] += (std::norm(std::conj(entry) - shift) - std::norm(entry)) * squares[i];
  }
  sums.within = (weights * rows.max(0.0)).sum();
  return sums;
}

ModalBounds::Result ModalBounds::of_track(std::size_t track) const {
  const auto b = static_cast<Eigen::Index>(track);
  const Vector scales = balancing_scales(track);
  Sums largest;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    largest.enlarge(sums(samples_[i], norms_[i], track, scales));
  const double nearest = inverse_distances_.col(b).maxCoeff();
  Sums completed = largest;
  completed.complete_vectors();
  Result result{false, INFINITY};
  for (const double kappa :
       {unknown_scale(1.0 / nearest, sizes_[b]), std::pow(largest.to_Lambda / largest.from_Lambda, 0.25)}) {
    // Not a number where this scale does not exist.
    const double Z1 = largest.Z1(kappa, nearest);
    if (Z1 < result.Z1) result.Z1 = Z1;
    const double Z2 = bound_curvature_safety * 2.0 * kappa * nearest;
    const double room = 1.0 - completed.Z1(kappa, nearest);
    result.closes = result.closes || (room > 0.0 && room * room > 2.0 * Z2 * completed.Y(kappa));
  }
  return result;
}

}  // namespace eigentrail
