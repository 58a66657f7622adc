// Length and phase of the stored mode shapes.
#pragma once

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// v^H M v, or zero if it is at the rounding level, that is, if the shape moves no mass.
double mass_norm_squared(const ComplexVector& v, const SystemMatrix& M);

/// v scaled to v^H M v = 1 (to v^H v = 1 if the mode moves no mass), with the phase that makes reference^H M
/// v real and positive, so that shapes change smoothly along the path. If the reference is empty or
/// orthogonal to v, the component of largest magnitude is made real and positive.
ComplexVector normalize_shape(const ComplexVector& v, const SystemMatrix& M, const ComplexVector& reference);

}  // namespace eigentrail
