// Length and phase of stored mode shapes.
#pragma once

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// v^H M v, or zero when that is no more than rounding: the shape moves no mass.
double mass_norm_squared(const ComplexVector& v, const SystemMatrix& M);

/// v scaled to v^H M v = 1 (to v^H v = 1 where the mode moves no mass), its phase fixed so that reference^H M
/// v is real and positive: shapes then change smoothly along the path. With an empty reference, or one
/// orthogonal to v, the component of largest magnitude is made real and positive.
ComplexVector normalize_shape(const ComplexVector& v, const SystemMatrix& M, const ComplexVector& reference);

}  // namespace eigentrail
