#include "eigentrail/core/complex_lu.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::complex_lu_test {
namespace {

/// Without a leading pivot: rows must change places.
ComplexMatrix some_matrix(Eigen::Index n) {
  ComplexMatrix A = ComplexMatrix::Random(n, n);
  A(0, 0) = 0.0;
  return A;
}

TEST(ComplexLu, SolvesItsEquationsAndTheirAdjoint) {
  for (const Eigen::Index n : {1, 2, 7, 60, 150}) {
    const ComplexMatrix A = n == 1 ? ComplexMatrix::Constant(1, 1, {0.3, -2.0}) : some_matrix(n);
    const ComplexLu lu(A);
    const ComplexVector x = ComplexVector::Random(n);
    ComplexVector solution = A * x;
    lu.solve_in_place(solution);
    EXPECT_LT((solution - x).norm(), 1e-10 * x.norm()) << n;
    ComplexVector adjoint = A.adjoint() * x;
    lu.solve_adjoint_in_place(adjoint);
    EXPECT_LT((adjoint - x).norm(), 1e-10 * x.norm()) << n;
    const ComplexMatrix X = ComplexMatrix::Random(n, 3);
    ComplexMatrix solutions = A * X;
    lu.solve_in_place(solutions);
    EXPECT_LT((solutions - X).norm(), 1e-10 * X.norm()) << n;
    ComplexMatrix adjoints = A.adjoint() * X;
    lu.solve_adjoint_in_place(adjoints);
    EXPECT_LT((adjoints - X).norm(), 1e-10 * X.norm()) << n;
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
}  // namespace eigentrail::test::complex_lu_test
