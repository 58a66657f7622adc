// Bounds of the certificate in modal coordinates (modal_certificate.hpp), on one piece of a step.
//
// The unknowns of a track b are the modal coordinates X_a of its vectors in all other tracks a, and Lambda.
// The norm is that of (X_a / d_a, Lambda / kappa). The scales d balance the matrix that is bounded (Osborne,
// Journal of the ACM 7, 1960), and kappa balances what goes from Lambda to X with what returns. Without, the
// bounds are up to a hundred times larger where vectors are nearly parallel, and a step takes as many pieces.
#pragma once

#include <vector>

#include "eigentrail/modes/all_pairs.hpp"

namespace eigentrail {

/// The tracks of a piece in modal coordinates: rows as in ModalBasis::coordinates.
struct ModalPlaces {
  std::vector<PairSet::Place> places;       ///< of every track
  std::vector<Eigen::Index> conjugate_row;  ///< for every row, that of the conjugate; itself if it is real

  ModalPlaces(std::vector<PairSet::Place> of_tracks, const ModalBasis& basis);
  Eigen::Index rows() const { return static_cast<Eigen::Index>(conjugate_row.size()); }
};

/// What differs at a sample point from the middle of the piece.
struct ModalSample {
  ComplexMatrix E;       ///< A(t) = V (D + E(t)) V^-1: the columns of the tracks, without their conjugates
  ComplexMatrix defect;  ///< residuals of the interpolated pairs at t
  ComplexMatrix Lambda;  ///< their Lambda less that at the middle, as in PairSet
};

/// Bounds of all tracks.
class ModalBounds {
 public:
  /// `inverse_distances` (rows x tracks): for every row and every track b, the norm of the inverse of
  /// X -> D_a X - X Lambda_b, where a is the track of the row; zero in the rows of b. `sizes`: norm of Lambda
  /// of every track. Keeps references to its arguments.
  ModalBounds(const ModalPlaces& places, const std::vector<ModalSample>& samples,
              const Matrix& inverse_distances, const Vector& sizes);

  struct Result {
    bool closes;  ///< whether the test closes
    double Z1;    ///< with the change of the vectors to first order
  };
  Result of_track(std::size_t track) const;

 private:
  struct Sums;
  Vector balancing_scales(std::size_t track) const;
  Sums sums(const ModalSample& sample, const Matrix& norms, std::size_t track, const Vector& scales) const;

  const ModalPlaces& places_;
  const std::vector<ModalSample>& samples_;
  const Matrix& inverse_distances_;
  const Vector& sizes_;
  /// For every sample: squared norms of the rows of E (rows x tracks) in the columns of a track and their
  /// conjugates.
  std::vector<Matrix> norms_;
};

}  // namespace eigentrail
