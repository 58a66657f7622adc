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
// a part of which there is one, with the function 1 only. Conditions of a trim are evaluated on one
// blade or on the support, each over its own coordinates and multipliers, which are the collective ones.
// Nothing is averaged: the coefficients are constant for N >= 3 as long as the hub stays on the axis of
// rotation, which is checked.
#pragma once

#include "model/assembly.hpp"
#include "model/multiblade/multiblade_map.hpp"

namespace eigentrail {

/// One blade, which stands for all of them, or the support.
struct RotorPart {
  Assembly assembly;       ///< elements and constraints, over the coordinates of the scene
  std::vector<int> trims;  ///< for every condition of a trim: its index among those of the rotor
  int count = 1;           ///< how many of them there are
  std::vector<Harmonic> harmonics = {Harmonic{}};
  /// By harmonic: G_a, and the like for the multipliers of constraints.
  std::vector<SparseMatrix> coordinates = {}, multipliers = {};
};

struct BladedRotorData {
  RotorPart blade, support;
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
};

}  // namespace eigentrail
