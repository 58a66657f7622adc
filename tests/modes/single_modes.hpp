// Shared by the tests of invariant pairs: tolerances, and the correction of one mode from a guess.
#pragma once

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail::test {

constexpr double tolerance = 1e-12;
constexpr double rounding = 1e-14;  // backward errors, and what a smooth function of the pencil keeps
constexpr double s_ref = 1e-3;

inline InvariantPair start_at(Complex s, const ComplexVector& z) {
  InvariantPair start;
  start.is_real = s.imag() == 0.0 && z.imag().isZero(0.0);
  start.Z = z;
  start.Lambda = ComplexMatrix::Constant(1, 1, s);
  return start;
}

inline InvariantPair correct_mode(const PencilAtPoint& point, Complex s, const ComplexVector& z,
                                  ModeCounts& counts) {
  return correct_pair(point, start_at(s, z), s_ref, {}, counts);
}

}  // namespace eigentrail::test
