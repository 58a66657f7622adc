// How far rounding of the matrices moves a special point, from the exact family alone.
#pragma once

#include "hard_cases/catalogue.hpp"
#include "hard_cases/family.hpp"

namespace eigentrail::test {

/// To first order, the largest change of the complex parameter of an exceptional point when every entry of
/// the matrices at that parameter changes by one unit rounding of the sum of the magnitudes of its terms:
///
///     eps |y|^T (|s|^2 |M| + |s| |C| + |K|) |z| / |y^H P_p z|
///
/// with the left and right null vectors y and z of P(s, p), from the singular values in extended precision.
/// Zero for special points of other kinds, at which P has two null vectors or none of its own.
double place_rounding(const Family& family, const SpecialPoint& point);

}  // namespace eigentrail::test
