// First frequencies of a blade without coupling, by which damping ratios are given.
#pragma once

#include "model/beam_table.hpp"

namespace eigentrail {

enum class BladeMotion { flap, lag, torsion };

/// Angular frequency (rad/s) of the first mode of a straight cantilever of that length in one motion alone:
/// at rest, without twist, shear and inertia of the sections in bending. It is the Rayleigh quotient of the
/// shape that the Ritz method finds at the first of the points that the scene is checked at, in polynomials
/// up to the sixth power of the span for torsion and the seventh for bending. The quotient is stationary in
/// the shape, so its derivatives by the parameters are those of the frequency.
Expression first_frequency(const Draft& draft, const BeamTable& table, const Expression& length,
                           BladeMotion motion);

}  // namespace eigentrail
