#include "eigentrail/modes/matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/families.hpp"

namespace eigentrail::test::matching_test {
namespace {

// Some ten roundings in each product of a handful of terms.
constexpr double rounding = 1e-14;

/// Symmetric positive definite.
Matrix mass_matrix(Eigen::Index n) {
  const Matrix R = random_matrix(n, n, 5);
  return R * R.transpose() + Matrix::Identity(n, n);
}

TEST(ModalAssurance, IsZeroForShapesOrthogonalInTheMass) {
  const Matrix M = mass_matrix(5);
  const ComplexVector v = random_complex(5, 1, 1);
  const ComplexVector other = random_complex(5, 1, 2);
  const ComplexVector Mv = M * v;
  const ComplexVector w = other - v * (Mv.dot(other) / Mv.dot(v));
  EXPECT_LT(modal_assurance(v, w, M)(0, 0), rounding);
  // For comparison, without the mass the two shapes are not orthogonal.
  EXPECT_GT(modal_assurance(v, w, Matrix::Identity(5, 5))(0, 0), 1e-3);
}

TEST(ModalAssurance, OfSmallShapesHasClosedForm) {
  Matrix M(2, 2);
  M << 2.0, 0.0, 0.0, 3.0;
  ComplexMatrix V(2, 2), W(2, 1);
  V << 1.0, 1.0, 0.0, Complex(0.0, 1.0);
  W << 1.0, 1.0;
  const Matrix mac = modal_assurance(V, W, M);
  ASSERT_EQ(mac.rows(), 2);
  ASSERT_EQ(mac.cols(), 1);
  EXPECT_NEAR(mac(0, 0), 2.0 * 2.0 / (2.0 * 5.0), rounding);
  EXPECT_NEAR(mac(1, 0), (2.0 * 2.0 + 3.0 * 3.0) / (5.0 * 5.0), rounding) << "|2 - 3j|^2";
}

TEST(ModalAssurance, DoesNotDependOnTheLengthOfShapesOrTheUnitOfMass) {
  const Matrix M = mass_matrix(4);
  const ComplexMatrix V = random_complex(4, 3, 1);
  const ComplexMatrix W = random_complex(4, 3, 2);
  const Vector lengths = (Vector(3) << 1e-8, 1.0, 1e8).finished();
  const Matrix scaled = modal_assurance(V * lengths.asDiagonal(), W * Complex(0.0, -5.0), 1e3 * M);
  EXPECT_LT((scaled - modal_assurance(V, W, M)).norm(), rounding);
}

TEST(ModalAssurance, TellsAShapeFromItsConjugateUnlessItIsReal) {
  const Matrix M = Matrix::Identity(2, 2);
  ComplexVector whirl(2);
  whirl << 1.0, Complex(0.0, 1.0);
  EXPECT_LT(modal_assurance(whirl, whirl.conjugate(), M)(0, 0), rounding) << "forward and backward whirl";
  const ComplexVector real = whirl.real().cast<Complex>();
  EXPECT_NEAR(modal_assurance(real, real.conjugate(), M)(0, 0), 1.0, rounding);
}

TEST(ModalAssurance, ComparesShapesThatMoveNoMassByTheirComponents) {
  // A massless freedom with a damper and a spring has such a mode, s = -k / c; the mass alone gives 0 / 0.
  const Matrix M = Eigen::Vector3d(2.0, 0.0, 0.0).asDiagonal();
  ComplexMatrix V = ComplexMatrix::Zero(3, 3);
  V(0, 0) = 1.0;
  V(1, 1) = Complex(0.0, 2.0);
  V(2, 2) = 1.0;
  const Matrix mac = modal_assurance(V, V, M);
  EXPECT_LT((mac - Matrix::Identity(3, 3)).norm(), rounding) << mac;
}

double total(const Matrix& cost, const std::vector<int>& column_of) {
  double sum = 0.0;
  for (std::size_t i = 0; i < column_of.size(); ++i) sum += cost(static_cast<Eigen::Index>(i), column_of[i]);
  return sum;
}

bool one_to_one(const std::vector<int>& column_of) {
  std::vector<int> sorted = column_of;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (sorted[i] != static_cast<int>(i)) return false;
  }
  return true;
}

double least_total_of_all_permutations(const Matrix& cost) {
  std::vector<int> permutation(static_cast<std::size_t>(cost.rows()));
  std::iota(permutation.begin(), permutation.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    least = std::min(least, total(cost, permutation));
  } while (std::next_permutation(permutation.begin(), permutation.end()));
  return least;
}

TEST(OptimalAssignment, IsTheBestOfAllPermutations) {
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::uniform_int_distribution<int> few_values(0, 2);
  for (int n = 1; n <= 7; ++n) {
    for (int repetition = 0; repetition < 10; ++repetition) {
      const Matrix generic = Matrix::NullaryExpr(n, n, [&] { return uniform(generator); });
      const Matrix tied = Matrix::NullaryExpr(n, n, [&] { return double(few_values(generator)); });
      for (const Matrix& cost : {generic, tied, Matrix(1e6 * generic), Matrix(generic.array() - 100.0)}) {
        const std::vector<int> assignment = optimal_assignment(cost);
        ASSERT_TRUE(one_to_one(assignment));
        EXPECT_NEAR(total(cost, assignment), least_total_of_all_permutations(cost),
                    rounding * n * cost.cwiseAbs().maxCoeff())
            << cost;
      }
    }
  }
}

TEST(OptimalAssignment, BeatsTheCheapestColumnOfEachRowAndTheGreedyChoice) {
  Matrix cost(3, 3);
  cost << 1.0, 1.1, 9.0,  //
      1.2, 9.0, 9.0,      //
      9.0, 9.0, 0.0;
  // For comparison: the cheapest column of each row is no one-to-one assignment.
  std::vector<int> cheapest(3);
  for (int i = 0; i < 3; ++i) cost.row(i).minCoeff(&cheapest[static_cast<std::size_t>(i)]);
  EXPECT_FALSE(one_to_one(cheapest));
  // For comparison: taking the cheapest remaining pair repeatedly ends with the costly pair (1, 1).
  const std::vector<int> greedy = {0, 1, 2};
  EXPECT_EQ(optimal_assignment(cost), (std::vector<int>{1, 0, 2}));
  EXPECT_LT(total(cost, optimal_assignment(cost)), total(cost, greedy));
}

TEST(OptimalAssignment, OfNothingIsEmpty) {
  EXPECT_TRUE(optimal_assignment(Matrix(0, 0)).empty());
}

TEST(OptimalAssignment, LeavesColumnsWithoutARow) {
  // As with rows of zeros for the columns that are left.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    Matrix square = Matrix::Zero(7, 7);
    square.topRows(4) = Matrix::NullaryExpr(4, 7, [&] { return uniform(random); });
    std::vector<int> rows = optimal_assignment(square);
    rows.resize(4);
    EXPECT_EQ(optimal_assignment(square.topRows(4)), rows);
  }
}

TEST(OptimalAssignment, RefusesCostsWithTooFewColumnsOrThatAreNotFinite) {
  EXPECT_THROW(optimal_assignment(Matrix::Zero(3, 2)), std::invalid_argument);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    Matrix cost = Matrix::Identity(3, 3);
    cost(1, 2) = bad;
    EXPECT_THROW(optimal_assignment(cost), std::invalid_argument) << bad;
  }
}

TEST(OptimalAssignment, CostsWhoseDifferencesOverflowAreRefused) {
  EXPECT_THROW((void)optimal_assignment(Matrix{{1.7e308, -1.7e308}, {1.7e308, -1.7e308}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace eigentrail::test::matching_test
