#pragma once

#include <Eigen/LU>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Reciprocal condition number, estimated; 0 where a pivot vanishes, which Eigen's own estimate (3.4) does
/// not notice.
inline double reciprocal_condition(const Eigen::PartialPivLU<Matrix>& lu) {
  return lu.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0 ? lu.rcond() : 0.0;
}

}  // namespace eigentrail
