// Shared by the tests of the methods that compute all pairs together: starting values from LAPACK, and
// comparison with pairs that are computed one by one.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "modes/single_modes.hpp"

namespace eigentrail::test {

constexpr int order = 5;
/// Of coefficients of order 5: they sum products of up to five ratios of matrices to gaps.
constexpr double series_rounding = 1e-10;

/// All modes at the start by LAPACK, each in a track of its own, with vectors and values off by `error`.
inline std::vector<InvariantPair> starts_of(const ReducedPencil& family, double error) {
  std::vector<InvariantPair> starts;
  for (const StartingMode& mode : compute_spectrum(family.M[0], family.C[0], family.K[0]).modes) {
    ComplexVector z = mode.z / mode.z.norm();
    z += error * ComplexVector::Ones(z.size());
    if (mode.s.imag() == 0.0) z.imag().setZero();
    starts.push_back(start_at(mode.s * (1.0 + error), z));
  }
  return starts;
}

/// The coefficients of a pair's series to `order`.
inline void expect_same_series(const PairSeries& found, const PairSeries& expected, std::size_t pair) {
  for (std::size_t j = 0; j <= order; ++j) {
    const double of_Z = expected.Z[j].norm(), of_Lambda = expected.Lambda[j].norm();
    EXPECT_LT((found.Z[j] - expected.Z[j]).norm(), series_rounding * (1.0 + of_Z))
        << "coefficient " << j << " of pair " << pair;
    EXPECT_LT((found.Lambda[j] - expected.Lambda[j]).norm(), series_rounding * (1.0 + of_Lambda))
        << "coefficient " << j << " of pair " << pair;
  }
}

}  // namespace eigentrail::test
