// The norm in which the Newton-Kantorovich ball of a pair is measured.
#pragma once

#include <memory>

#include "continuation/step/adapted_norm.hpp"
#include "continuation/step/energy_norm.hpp"

namespace eigentrail {

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
