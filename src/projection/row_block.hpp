// A few vectors side by side, stored row by row.
#pragma once

#include <Eigen/Core>

namespace eigentrail {

/// A sparse matrix is read once for all columns of such a block, n x k, and not once for each.
using RowBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace eigentrail
