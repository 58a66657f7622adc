// Factors of the summands of affine families.
#pragma once

#include <span>
#include <vector>

#include "eigentrail/model/affine_family.hpp"
#include "model/rotor/tabulated_factor.hpp"

namespace eigentrail {

/// The parameters along a path, in SI units.
template <class Real, int Q>
std::vector<Series<Real, Q>> si_series(const Parameters& parameters, const BasicPath<Real>& path) {
  std::vector<Series<Real, Q>> si(parameters.size());
  for (std::size_t i = 0; i < si.size(); ++i) {
    for (int k = 0; k <= Q; ++k) si[i][k] = coefficient(path.parameters, static_cast<Eigen::Index>(i), k);
  }
  parameters.to_si(std::span<Series<Real, Q>>(si));
  return si;
}

/// The factor of a summand for given values of the parameters (SI).
template <class Scalar, class Storage>
Scalar factor_of(const AffineTerm<Storage>& term, std::span<const Scalar> si) {
  const Scalar value = term.factor.evaluate(si);
  return term.table ? (*term.table)(value)*term.scale.evaluate(si) : value;
}

}  // namespace eigentrail
