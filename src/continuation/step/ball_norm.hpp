// The norm in which the Newton-Kantorovich ball of a pair is measured. It consists of one in which stiff and
// soft directions of a pencil count alike, and one in which an operator that is far from normal is about as
// large as its eigenvalues.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "core/band_matrix.hpp"
#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

/// Scales d such that the rows and columns of D^-1 A D are about equally large beside the diagonal (Osborne,
/// Journal of the ACM 7, 1960), from the squares of the entries of A (n x n). Rows and columns without
/// entries keep the scale one. Cost n^2 per sweep.
Vector balancing_scales(Matrix squares, int sweeps);

/// The norm |S^-1 x|, where S = I + Q (D - I) Q^H with orthonormal columns Q and a positive diagonal D. Where
/// an operator T is large on few directions only, as for the bearings of a rotor, and its range there is
/// mapped to little, the norm of S^-1 T S is far below that of T. S is Hermitian.
class AdaptedNorm {
 public:
  /// The plain norm.
  AdaptedNorm() = default;

  /// The norm that balances T (balancing_scales) as a matrix of norms: one row and column
  /// for every column of Q (n x r, orthonormal), and one for all that is orthogonal to them. The columns of Q
  /// should be the left singular vectors of T with the largest singular values. `TQ`: T Q. `adjoint`: T^H Q.
  static AdaptedNorm balancing(ComplexMatrix Q, const ComplexMatrix& TQ, const ComplexMatrix& adjoint);

  /// Overwrites a vector, or the columns of a matrix, with S X; S^-1 X.
  template <class Columns>
  void apply(Columns& X) const {
    scale(X, factors_);
  }
  template <class Columns>
  void apply_inverse(Columns& X) const {
    scale(X, factors_.cwiseInverse());
  }

  bool is_plain() const { return factors_.size() == 0; }

 private:
  template <class Columns>
  void scale(Columns& X, const Vector& factors) const {
    if (is_plain()) return;
    const Columns parts = Q_.adjoint() * X;
    X += Q_ * ((factors.array() - 1.0).matrix().cast<Complex>().asDiagonal() * parts);
  }

  ComplexMatrix Q_;
  Vector factors_;  ///< the diagonal of D
};

/// The norm |R x|, R^T R = H, by which a change dP of the pencil P = w^2 M + w C + K at a real shift w > 0 is
/// measured relative to P itself, whatever the units of the coordinates and however far their stiffnesses are
/// apart. H is the symmetric part of P where that is positive definite, so that |R x|^2 = x^T P x is the
/// energy; else the positive definite factor of the polar decomposition P = Q H.
class EnergyNorm {
 public:
  /// By a Cholesky factorization; if the symmetric part is not positive definite, by a singular value
  /// decomposition in about 8 n^3 multiplications. Null if P is singular or not finite.
  static std::shared_ptr<const EnergyNorm> of(const PencilAtPoint& pencil, double shift);

  /// R X, R^T X, R^-1 X and R^-T X for the columns of X, n rows.
  ComplexMatrix times(const ComplexMatrix& X) const;
  ComplexMatrix transposed_times(const ComplexMatrix& X) const;
  ComplexMatrix inverse_times(const ComplexMatrix& X) const;
  ComplexMatrix inverse_transposed_times(const ComplexMatrix& X) const;

 private:
  EnergyNorm(Matrix root, Matrix inverse_root)
      : root_(std::move(root)), inverse_root_(std::move(inverse_root)) {}
  explicit EnergyNorm(BandCholesky band) : band_(std::move(band)) {}
  /// Of the polar decomposition; null as above.
  static std::shared_ptr<const EnergyNorm> of_polar_factor(Matrix P);

  std::optional<BandCholesky> band_;  ///< R where it is banded
  Matrix root_, inverse_root_;        ///< R and R^-1 where it is not
};

/// The norm |S^-1 x| of the unknowns x = (vec Z, vec Lambda / scale) of a pair: S = (I x R^-1 + I) D, where R
/// is that of an energy norm, for every column of Z, and D that of an adapted norm. Plain until they are set.
class BallNorm {
 public:
  /// Z is n x k.
  BallNorm(Eigen::Index n, Eigen::Index k) : n_(n), k_(k) {}

  /// From here on by energy, scaled so that it leaves the norm of Z as it is.
  void set_energy(std::shared_ptr<const EnergyNorm> energy, const ComplexMatrix& Z);
  /// From here on adapted; `norm` is one of the unknowns in the energy norm.
  void set_adapted(AdaptedNorm norm) { adapted_ = std::move(norm); }

  /// Overwrites a vector, or the columns of a matrix, with S X, S^H X, S^-1 X, S^-H X.
  template <class Columns>
  void apply(Columns& X) const {
    adapted_.apply(X);
    scale(X, &EnergyNorm::inverse_times, 1.0 / factor_);
  }
  template <class Columns>
  void apply_adjoint(Columns& X) const {
    scale(X, &EnergyNorm::inverse_transposed_times, 1.0 / factor_);
    adapted_.apply(X);
  }
  template <class Columns>
  void apply_inverse(Columns& X) const {
    scale(X, &EnergyNorm::times, factor_);
    adapted_.apply_inverse(X);
  }
  template <class Columns>
  void apply_inverse_adjoint(Columns& X) const {
    adapted_.apply_inverse(X);
    scale(X, &EnergyNorm::transposed_times, factor_);
  }

  /// Bound of |Lambda / scale| for unknowns of norm one.
  double largest_eigenvalue_part() const;

 private:
  using Map = ComplexMatrix (EnergyNorm::*)(const ComplexMatrix&) const;
  /// Overwrites every column of Z in every column of X with `factor` times what the map makes of it.
  template <class Columns>
  void scale(Columns& X, Map map, double factor) const {
    if (!energy_) return;
    for (Eigen::Index i = 0; i < k_; ++i) {
      auto block = X.middleRows(i * n_, n_);
      block = factor * ((*energy_).*map)(block);
    }
  }

  Eigen::Index n_, k_;
  std::shared_ptr<const EnergyNorm> energy_;
  double factor_ = 1.0;
  AdaptedNorm adapted_;
};

}  // namespace eigentrail
