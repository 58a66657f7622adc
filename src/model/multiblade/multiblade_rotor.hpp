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

#include "model/multiblade/harmonics.hpp"
#include "model/multiblade/multiblade_map.hpp"
#include "model/multibody.hpp"

namespace eigentrail {

/// Equal parts of the rotor: N blades, or one support, which is constant over the azimuth.
struct RotorPart {
  Assembly equations;  ///< elements and constraints of one of them, over the coordinates of the scene
  int count = 1;
  std::vector<Harmonic> harmonics;
  std::vector<RotorShares> shares;  ///< G_a by harmonic
  /// By row of its constraints: that of the rotor for the first harmonic, those for the others follow; -1 for
  /// constraints of other parts.
  std::vector<int> rows;
  std::vector<int> trims;  ///< for each of its conditions: index among those of the rotor
};

/// Equations of the rotor, for a RecordedModel.
struct RotorEquations {
  RotorPart blade, support;
  MultibladeMap map;
  Expression speed;  ///< Omega, rad/s
  std::string hub;   ///< its name, for messages

  const MultibodyData& data() const { return blade.equations.data(); }
  Eigen::Index coordinate(std::size_t of_scene) const;
  ModelDescription with_costs(ModelDescription description) const;
  Structure structure(const std::vector<int>& moving) const;

  /// Of the steady state, in which only collective coordinates and multipliers have a part. A fault if the
  /// hub leaves the axis of rotation.
  template <class Real>
  EvaluationFault residual(const BasicPath<Real>& path, int order, BasicSteadyResidual<Real>& result,
                           EvaluationCounts& counts) const;
  template <class Real>
  EvaluationFault linearize(const BasicPath<Real>& path, int order, BasicLinearization<Real>& result,
                            EvaluationCounts& counts) const;
  EvaluationFault trim_rows(const Path& at, TrimDerivatives& result, EvaluationCounts& counts) const;
};

using MultibladeRotor = RecordedModel<RotorEquations>;

}  // namespace eigentrail
