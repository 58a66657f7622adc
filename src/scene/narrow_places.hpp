// Where expressions of the scene change within a small part of the range: narrow bumps, steep transitions.
// Points of a trace on both sides of such a place do not show it. Expressions are known as formulas, so it is
// known before the first step.
#pragma once

#include <span>
#include <vector>

#include "eigentrail/core/types.hpp"
#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// Places between `from` and `to`, ascending, where one of the expressions, or of the definitions of
/// parameters, needs intervals much shorter than the range for a Taylor polynomial to describe it, and
/// shorter than beside the place. `values`: of all parameters in declared units; the entry of the traced one
/// is not used. Places where an expression is not finite are left out. Cost: some hundred evaluations of
/// every expression.
std::vector<double> narrow_places(const Parameters& parameters, const Vector& values, int traced, double from,
                                  double to, std::span<const Expression> expressions);

}  // namespace eigentrail
