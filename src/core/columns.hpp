// Maps of vectors, applied to the columns of a matrix.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Overwrites every column of B with what `map` makes of it in place.
template <class Map>
void for_each_column(ComplexMatrix& B, Map map) {
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    ComplexVector column = B.col(j);
    map(column);
    B.col(j) = column;
  }
}

}  // namespace eigentrail
