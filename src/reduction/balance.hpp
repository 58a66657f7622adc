// Balancing: factors for equations and coordinates by which no unit decides what is large.
#pragma once

#include <algorithm>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// Scaling of rows and columns by powers of two.
struct Balance {
  Vector rows, columns;

  Matrix of(const Matrix& A) const { return rows.asDiagonal() * A * columns.asDiagonal(); }
  double ratio() const {
    return std::max(rows.maxCoeff() / rows.minCoeff(), columns.maxCoeff() / columns.minCoeff());
  }
};

/// Makes the largest entries of all rows and columns of |M| w^2 + |C| w + |K| about equal, by powers of two
/// (Ruiz 2001). Symmetric matrices are scaled symmetrically. Coefficients n x n, any number of each.
Balance balance(const CoefficientMatrices& coefficients, Eigen::Index n);

}  // namespace eigentrail
