// The effects that a rotor is made of: what `explain` lists, what a strength multiplies and what --without
// leaves out.
#pragma once

#include <cstddef>

#include "eigentrail/model/affine_family.hpp"

namespace eigentrail {

struct RotorDraft;

enum class RotorEffect : std::size_t {
  shaft,             ///< elastic forces of shafts
  shaft_mass,        ///< inertia of shafts
  disc,              ///< inertia of discs
  gyroscopic,        ///< gyroscopic moments of shafts and discs
  shaft_damping,     ///< damping of shafts that does not rotate
  internal_damping,  ///< damping that rotates with the shaft
  bearing,
  seal,  ///< bearings with added mass
  support,
};
inline constexpr std::size_t rotor_effect_count = 9;

/// Throws InputError if an effect that the request leaves out is not in the scene, or cannot be left out.
void check_rotor_without(const RotorDraft& rotor);

/// The effects of the scene, in order, with what each of them contributes to n x n matrices.
std::vector<Effect> rotor_effects(const RotorDraft& rotor, Eigen::Index n);

/// The sum of all effects that are not left out. Each is multiplied by its strength, if strengths are asked
/// for.
AffinePencil<SparseMatrix> pencil_of_effects(RotorDraft& rotor, Eigen::Index n);

}  // namespace eigentrail
