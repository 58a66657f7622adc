#pragma once

#include <Eigen/LU>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Estimate of the reciprocal condition number in the 1-norm; 0 if a pivot is zero, which Eigen's own
/// estimate (3.4) does not detect.
template <class Values>
double reciprocal_condition(const Eigen::PartialPivLU<Values>& lu) {
  return lu.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0 ? lu.rcond() : 0.0;
}

}  // namespace eigentrail
