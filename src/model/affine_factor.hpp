// The summands of affine families: their factors, and the symmetry of their matrices.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/transposition.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "model/tabulated_factor.hpp"

namespace eigentrail {

/// The factor of a summand for given values of the parameters (SI).
template <class Scalar, class Storage>
Scalar factor_of(const AffineTerm<Storage>& term, std::span<const Scalar> si) {
  const Scalar value = term.factor.evaluate(si);
  return term.table ? apply(*term.table, value) * term.scale.evaluate(si) : value;
}

/// Whether all terms are symmetric (sign 1) or skew-symmetric (-1).
template <class Storage>
bool all_equal_transposes(const std::vector<AffineTerm<Storage>>& terms, double sign) {
  return std::all_of(terms.begin(), terms.end(),
                     [sign](const AffineTerm<Storage>& term) { return equals_transpose(term.matrix, sign); });
}

/// What a damping matrix contributes that is a sum of these terms, or interpolated between these samples.
Contribution damping_parts(const auto& all) {
  return {.dissipative = !all_equal_transposes(all, -1.0), .gyroscopic = !all_equal_transposes(all, 1.0)};
}
/// Likewise a stiffness matrix.
Contribution stiffness_parts(const auto& all) {
  return {.conservative = true, .circulatory = !all_equal_transposes(all, 1.0)};
}

}  // namespace eigentrail
