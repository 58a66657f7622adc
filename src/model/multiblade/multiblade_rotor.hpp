// Rotor of N equal blades on a support that stands, linearized in multiblade coordinates. All blades have the
// same steady state; the hub carries N times the load of one blade on and about the axis of rotation.
// Elements of one blade are evaluated once, whatever N.
//
// The equations of blade k and the hub as it sees it, M z'' + C z' + K z = 0 with A z = 0 in the turning
// frame, and z = G(psi_k) w (multiblade_map.hpp), give by the principle of virtual work, with D = d/dpsi,
//
//   M_w = N sum_a w_a G_a^T M G_a
//   C_w = N sum_a w_a G_a^T (C G_a + 2 Omega M (DG)_a)
//   K_w = N sum_a w_a G_a^T (K G_a + Omega C (DG)_a + Omega^2 M (D^2 G)_a)
//
// and rows N w_a A G_a for every harmonic a, so that the multipliers are those of one blade. The support is
// added. Conditions of a trim are evaluated on one blade or on the support, each over its own coordinates and
// multipliers, which are the collective ones. Nothing is averaged: the coefficients are constant for N >= 3
// as long as the hub stays on the axis of rotation, which is checked.
#pragma once

#include "model/assembly.hpp"
#include "model/multiblade/multiblade_map.hpp"

namespace eigentrail {

struct BladedRotorData {
  /// Elements and constraints of one blade and of the support, both over the coordinates of the scene.
  Assembly blade, support;
  /// For every condition of the blade and of the support: its index among those of the rotor.
  std::vector<int> trims_of_blade, trims_of_support;
  MultibladeMap map;
  Expression speed;               ///< Omega, rad/s
  std::string hub;                ///< its name, for messages
  std::vector<Expression> guess;  ///< by coordinate of points and bodies of the scene
  int n_states = 0;               ///< states of elements, the last coordinates of the rotor
};

class MultibladeRotor final : public Model {
 public:
  MultibladeRotor(ModelDescription description, BladedRotorData data);

  Vector initial_guess(const Vector& parameters) const override;
  Structure structure(int traced_parameter) const override;
  /// Of the steady state, in which only collective coordinates and multipliers have a part. A fault if the
  /// hub leaves the axis of rotation.
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override;
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  EvaluationFault trim_derivatives(const Path& at, TrimDerivatives& result,
                                   EvaluationCounts& counts) const override;
  std::vector<Expression> expressions() const override;
  EvaluationFault extended_residual(const BasicPath<Extended>& path,
                                    BasicSteadyResidual<Extended>& result) const override;
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override;

 private:
  BladedRotorData data_;
  std::vector<std::vector<std::vector<RotorShare>>> shares_;  ///< G_a by harmonic
};

}  // namespace eigentrail
