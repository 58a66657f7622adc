#include "eigentrail/core/complex_lu.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test {
namespace {

/// Without a leading pivot: rows must change places.
ComplexMatrix some_matrix(Eigen::Index n) {
  ComplexMatrix A = ComplexMatrix::Random(n, n);
  A(0, 0) = 0.0;
  return A;
}

TEST(ComplexLu, SolvesOneColumnLikeMany) {
  for (const Eigen::Index n : {1, 2, 7, 60, 150}) {
    const ComplexMatrix A = n == 1 ? ComplexMatrix::Constant(1, 1, {0.3, -2.0}) : some_matrix(n);
    const ComplexLu lu(A);
    const ComplexMatrix X = ComplexMatrix::Random(n, 3);
    ComplexMatrix many = A * X;
    lu.solve_in_place(many);
    EXPECT_LT((many - X).norm(), 1e-10 * X.norm());
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      ComplexVector one = A * X.col(j);
      lu.solve_in_place(one);
      EXPECT_LT((one - X.col(j)).norm(), 1e-10 * X.col(j).norm()) << n;
      ComplexVector adjoint = A.adjoint() * X.col(j);
      lu.solve_adjoint_in_place(adjoint);
      EXPECT_LT((adjoint - X.col(j)).norm(), 1e-10 * X.col(j).norm()) << n;
    }
  }
}

TEST(ComplexLu, SingularMatrixGivesNothingFinite) {
  ComplexMatrix A = some_matrix(5);
  A.col(3).setZero();
  ComplexVector b = ComplexVector::Ones(5);
  ComplexLu(A).solve_in_place(b);
  EXPECT_FALSE(b.allFinite());
}

}  // namespace
}  // namespace eigentrail::test
