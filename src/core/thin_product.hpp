// Products of blocks of modes: n x k times k x k, or k x n times n x k, with a k of two or three.
#pragma once

#include <Eigen/Core>

namespace eigentrail {

/// A B. Eigen's product of matrices first copies its factors into packed form, which takes longer than a
/// product with few columns.
template <class Left, class Right>
auto thin_product(const Left& A, const Right& B) {
  using Product = Eigen::Matrix<typename Right::Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr Eigen::Index few = 4;
  const bool is_thin = B.cols() <= few && (A.rows() <= few || A.cols() <= few);
  return is_thin ? Product(A.lazyProduct(B)) : Product(A * B);
}

}  // namespace eigentrail
