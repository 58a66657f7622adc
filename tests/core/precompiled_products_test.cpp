// Products that are compiled once (core/precompiled_products.hpp), against sums of products.
#include "core/precompiled_products.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <complex>

namespace eigentrail::test::precompiled_products_test {
namespace {

using Complex = std::complex<double>;
template <class Scalar, int order = Eigen::ColMajor>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, order>;

template <class Left, class Right>
auto sums(const Left& A, const Right& B) {
  Dense<decltype(A(0, 0) * B(0, 0))> C(A.rows(), B.cols());
  for (Eigen::Index i = 0; i < C.rows(); ++i) {
    for (Eigen::Index j = 0; j < C.cols(); ++j) {
      C(i, j) = 0.0;
      for (Eigen::Index k = 0; k < A.cols(); ++k) C(i, j) += A(i, k) * B(k, j);
    }
  }
  return C;
}

/// Sums of fewer than 40 products of numbers below two.
constexpr double rounding = 1e-13;

template <class Left, class Right>
void expect_products(Eigen::Index rows, Eigen::Index inner, Eigen::Index columns) {
  using Scalar = decltype(Left() * Right());
  const Dense<Left> A = Dense<Left>::Random(rows, inner);
  const Dense<Right> B = Dense<Right>::Random(inner, columns);
  const Dense<Left> A_adjoint = A.adjoint();
  const Dense<Right, Eigen::RowMajor> B_by_rows = B;
  const Dense<Scalar> AB = sums(A, B);
  EXPECT_LE((Dense<Scalar>(A * B) - AB).norm(), rounding);
  EXPECT_LE((Dense<Scalar>(A_adjoint.adjoint() * B_by_rows) - AB).norm(), rounding);
  EXPECT_LE((Dense<Scalar, Eigen::RowMajor>(2.0 * A * B_by_rows) - 2.0 * AB).norm(), rounding);
  Dense<Scalar> C = AB;
  C -= A_adjoint.adjoint() * (0.5 * B);
  C.noalias() += A * B;
  EXPECT_LE((C - 1.5 * AB).norm(), rounding);
  Dense<Scalar> block = Dense<Scalar>::Zero(rows + 2, columns + 1);
  block.block(1, 1, rows, columns).noalias() = (A + A) * B;
  EXPECT_LE((block.block(1, 1, rows, columns) - 2.0 * AB).norm(), rounding);
  EXPECT_LE(std::abs(block.norm() - 2.0 * AB.norm()), rounding);
  const Dense<Scalar> column = A * B.col(0);  // a matrix, not a vector
  EXPECT_LE((column - AB.col(0)).norm(), rounding);
  const Dense<Scalar, Eigen::RowMajor> row = A_adjoint.col(0).adjoint() * B;
  EXPECT_LE((row - AB.row(0)).norm(), rounding);
  Dense<Scalar> rows_of_B = Dense<Scalar>::Zero(3, columns);
  rows_of_B.row(1).noalias() += A.row(rows - 1) * B_by_rows;
  EXPECT_LE((rows_of_B.row(1) - AB.row(rows - 1)).norm(), rounding);
  EXPECT_LE((A * (B * B.adjoint()) - sums(A, Dense<Right>(B * B.adjoint()))).norm(), 10.0 * rounding);
}

TEST(PrecompiledProducts, AreSumsOfProductsInAllFormsAndSizes) {
  for (const Eigen::Index rows : {1, 2, 5, 19}) {
    for (const Eigen::Index inner : {1, 3, 8, 31}) {
      for (const Eigen::Index columns : {1, 2, 7, 22}) {
        SCOPED_TRACE(testing::Message() << rows << " x " << inner << " x " << columns);
        expect_products<double, double>(rows, inner, columns);
        expect_products<Complex, Complex>(rows, inner, columns);
        expect_products<double, Complex>(rows, inner, columns);
        expect_products<Complex, double>(rows, inner, columns);
      }
    }
  }
}

TEST(PrecompiledProducts, OfEmptyMatricesAreZero) {
  const Dense<double> A = Dense<double>::Random(4, 0), B = Dense<double>::Random(0, 3);
  EXPECT_EQ(Dense<double>(A * B), Dense<double>::Zero(4, 3));
  const Eigen::VectorXd x = Eigen::VectorXd::Random(4);
  EXPECT_EQ(Eigen::VectorXd(A * (A.transpose() * x)), Eigen::VectorXd::Zero(4));
}

}  // namespace
}  // namespace eigentrail::test::precompiled_products_test
