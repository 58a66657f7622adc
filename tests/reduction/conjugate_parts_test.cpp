// Conjugate pairs of complex parts: canonical coordinates of matrices that commute with a turn by 90 degrees.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "eigentrail/reduction/complex_blocks.hpp"
#include "eigentrail/reduction/independent_parts.hpp"
#include "eigentrail/reduction/reduced_pencil.hpp"
#include "support/families.hpp"

namespace eigentrail::test::conjugate_parts_test {
namespace {

constexpr double rounding = 1e-12;

/// a + ib in w = x + iy as a real matrix of (x1, y1, x2, y2, ...).
Matrix in_two_directions(const Matrix& a, const Matrix& b) {
  Matrix real(2 * a.rows(), 2 * a.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      real.block<2, 2>(2 * i, 2 * j) << a(i, j), -b(i, j), b(i, j), a(i, j);
  }
  return real;
}

/// Mass, damping with gyroscopic moments, and stiffness of m discs on an isotropic shaft.
CoefficientMatrices isotropic_shaft(Eigen::Index m) {
  const Matrix none = Matrix::Zero(m, m), R = random_matrix(m, m, 1), S = random_matrix(m, m, 2);
  const Matrix I = Matrix::Identity(m, m);
  return {{in_two_directions(I, none)},
          {in_two_directions(0.01 * I, none), in_two_directions(none, -(S * S.transpose() + I))},
          {in_two_directions(R * R.transpose() + I, none)}};
}

CoefficientMatrices in_coordinates(CoefficientMatrices all, const Matrix& left, const Matrix& right) {
  for (auto* matrices : {&all.M, &all.C, &all.K}) {
    for (Matrix& A : *matrices) A = (left.transpose() * A * right).eval();
  }
  return all;
}

/// Coordinates that are neither orthogonal nor close to singular.
Matrix mixing(Eigen::Index n, unsigned seed) {
  return 2.0 * Matrix::Identity(n, n) + 0.3 * random_matrix(n, n, seed);
}

std::shared_ptr<const IndependentParts> pairs_of(const CoefficientMatrices& all) {
  return find_conjugate_parts(all, find_independent_parts(all).get());
}

std::vector<int> complex_signs_of(const IndependentParts& parts) {
  std::vector<int> all;
  for (const auto& range : parts.ranges) all.push_back(range.complex_sign);
  return all;
}

TEST(ConjugateParts, OfAnIsotropicShaftAreFoundInAnyCoordinates) {
  const CoefficientMatrices given = isotropic_shaft(5);
  const Matrix I = Matrix::Identity(10, 10), T = mixing(10, 7), L = mixing(10, 8);
  EXPECT_EQ(find_independent_parts(given), nullptr) << "real coordinates do not separate it";
  for (const auto& [left, right] : {std::pair(I, I), std::pair(T, T), std::pair(L, T)}) {
    const CoefficientMatrices all = in_coordinates(given, left, right);
    const auto parts = pairs_of(all);
    ASSERT_NE(parts, nullptr);
    EXPECT_EQ(complex_signs_of(*parts), std::vector<int>({1, -1}));
    EXPECT_EQ(parts->freedoms(), 10);
    EXPECT_TRUE(parts->falls_apart());
    EXPECT_NE(parts->ranges[0].like, parts->ranges[1].like);
    EXPECT_LT((parts->inverse * parts->right - I).norm(), rounding);
    for (const auto* matrices : {&all.M, &all.C, &all.K}) {
      for (const Matrix& A : *matrices) {
        const Matrix there = parts->left.transpose() * A * parts->right;
        EXPECT_LT((there - canonical_form(there)).norm(), rounding * there.norm());
      }
    }
  }
}

/// In x and y the coordinates stay those that are given, and symmetric equations stay symmetric.
TEST(ConjugateParts, KeepCoordinatesAndSymmetry) {
  const auto parts = pairs_of(isotropic_shaft(3));
  ASSERT_NE(parts, nullptr);
  EXPECT_EQ(parts->left, parts->right);
  for (Eigen::Index j = 0; j < 3; ++j) {
    EXPECT_EQ(parts->right.col(j), Vector(Vector::Unit(6, 2 * j)));
    EXPECT_EQ(parts->right.col(3 + j), Vector(Vector::Unit(6, 2 * j + 1)));
  }
  const CoefficientMatrices mixed = in_coordinates(isotropic_shaft(3), mixing(6, 3), mixing(6, 3));
  const auto there = pairs_of(mixed);
  ASSERT_NE(there, nullptr);
  EXPECT_EQ(there->left, there->right);
}

/// Without gyroscopic moments both directions are equal parts, of which one is followed: no pair.
TEST(ConjugateParts, AreNoneWhereBothDirectionsAreEqualParts) {
  CoefficientMatrices all = isotropic_shaft(3);
  all.C.pop_back();
  EXPECT_EQ(pairs_of(all), nullptr);
}

/// A shaft beside another structure, and the same shaft again.
TEST(ConjugateParts, AreFoundAmongOtherPartsAndCopies) {
  const CoefficientMatrices shaft = isotropic_shaft(2);
  const Matrix other = random_matrix(3, 3, 5), stiffness = other * other.transpose() + Matrix::Identity(3, 3);
  const auto beside = [&](const Matrix& A, const Matrix& B) {
    Matrix all = Matrix::Zero(11, 11);
    all.topLeftCorner(4, 4) = all.block(4, 4, 4, 4) = A;
    all.bottomRightCorner(3, 3) = B;
    return all;
  };
  const CoefficientMatrices all{{beside(shaft.M[0], Matrix::Identity(3, 3))},
                                {beside(shaft.C[0], random_matrix(3, 3, 6)), beside(shaft.C[1], stiffness)},
                                {beside(shaft.K[0], stiffness)}};
  for (const bool mixed : {false, true}) {
    const Matrix T = mixing(11, 10);
    const CoefficientMatrices here = mixed ? in_coordinates(all, T, T) : all;
    const auto parts = pairs_of(here);
    ASSERT_NE(parts, nullptr);
    EXPECT_EQ(parts->freedoms(), 11);
    ASSERT_EQ(parts->count(), 3U);
    const auto pair = std::find_if(parts->ranges.begin(), parts->ranges.end(),
                                   [](const auto& range) { return range.complex_sign > 0; });
    ASSERT_NE(pair, parts->ranges.end());
    ASSERT_EQ(pair->copies.size(), 1U);
    EXPECT_LT(((pair + 1)->copies[0].right - pair->copies[0].right).norm(), rounding);
    const auto index = static_cast<std::size_t>(pair - parts->ranges.begin());
    const auto left = parts->left.middleCols(pair->first, pair->size);
    for (const auto* matrices : {&here.M, &here.C, &here.K}) {
      for (const Matrix& A : *matrices) {
        const Matrix own = left.transpose() * A * parts->columns(index);
        const Matrix copy = pair->copies[0].left.transpose() * A * pair->copies[0].right;
        EXPECT_LT((own - copy).norm(), rounding * A.norm());
      }
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::conjugate_parts_test
