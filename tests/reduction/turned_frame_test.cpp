// Coordinates that turn with the tangent space, in which a symmetry of the structure stays the same matrix.
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/reduction/independent_parts.hpp"
#include "eigentrail/reduction/tangent_basis.hpp"
#include "reduction/separated_basis.hpp"
#include "support/families.hpp"

namespace eigentrail::test::turned_frame_test {
namespace {

/// Coordinates of the next of three equal parts with four coordinates each take the place of those of this.
Matrix rotation_of_three(Eigen::Index size) {
  Matrix G = Matrix::Zero(3 * size, 3 * size);
  for (Eigen::Index i = 0; i < 3; ++i) G.block(size * ((i + 1) % 3), size * i, size, size).setIdentity();
  return G;
}

/// Constraints of three equal parts with two rows each, by the state p of a part.
ConstraintFactorization constraints_of_three(double p) {
  const Matrix one = random_matrix(2, 4, 3) + p * random_matrix(2, 4, 4);
  Matrix A = Matrix::Zero(6, 12);
  for (Eigen::Index i = 0; i < 3; ++i) A.block(2 * i, 4 * i, 2, 4) = one;
  return ConstraintFactorization(SystemMatrix(A));
}

TEST(TurnedFrame, IsAnOrthonormalBasisOfTheTangentSpace) {
  const Matrix frame = constraints_of_three(0.0).null_basis();
  const ConstraintFactorization there = constraints_of_three(0.2);
  const Matrix T = turned_frame(there, frame).value();
  EXPECT_LT((T.transpose() * T - Matrix::Identity(6, 6)).norm(), 1e-14);
  EXPECT_LT((there.allowed_part(T) - T).norm(), 1e-14);
  EXPECT_LT((turned_frame(constraints_of_three(0.0), frame).value() - frame).norm(), 1e-14);
}

/// In one plane, the basis turns by the angle of the plane.
TEST(TurnedFrame, TurnsByTheAngleOfThePlane) {
  const auto plane = [](double angle) {
    return ConstraintFactorization(SystemMatrix(Matrix{{-std::sin(angle), 0.0, std::cos(angle)}}));
  };
  const Matrix frame = Matrix{{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}};
  const Matrix expected = Matrix{{std::cos(1.2), 0.0}, {0.0, 1.0}, {std::sin(1.2), 0.0}};
  EXPECT_LT((turned_frame(plane(1.2), frame).value() - expected).norm(), 1e-14);
  EXPECT_TRUE(turned_frame(plane(1.39), frame));
  EXPECT_FALSE(turned_frame(plane(1.41), frame)) << "80 degrees are 1.396";
  EXPECT_FALSE(turned_frame(ConstraintFactorization(SystemMatrix(Matrix::Identity(2, 3))), frame));
}

/// Orthogonal changes of coordinates commute with it. The basis by Cholesky, which follows a trace from point
/// to point, depends on the order of its columns, and changes the matrix of the symmetry.
TEST(TurnedFrame, KeepsASymmetry) {
  const Matrix G = rotation_of_three(4);
  const Matrix mixed = Matrix(random_matrix(6, 6, 8).householderQr().householderQ());
  const Matrix frame = constraints_of_three(0.0).null_basis() * mixed;
  const Matrix D = frame.transpose() * G * frame;
  double kept = 0.0, rival = 0.0;
  for (const double p : {0.1, 0.2, 0.3}) {
    const ConstraintFactorization there = constraints_of_three(p);
    const Matrix T = turned_frame(there, frame).value();
    kept = std::max(kept, (T.transpose() * G * T - D).norm());
    const Matrix other = tangent_basis(there, frame).T[0];
    rival = std::max(rival, (other.transpose() * G * other - D).norm());
  }
  EXPECT_LT(kept, 1e-13);
  EXPECT_GT(rival, 1e-3);
}

TEST(SeparatedBasis, HasColumnsOfOnePartEach) {
  const ConstraintFactorization constraints = constraints_of_three(0.3);
  const Matrix T = separated_basis(constraints);
  EXPECT_LT((T.transpose() * T - Matrix::Identity(6, 6)).norm(), 1e-14);
  EXPECT_LT((constraints.allowed_part(T) - T).norm(), 1e-14);
  const auto touches = [](const Matrix& basis, Eigen::Index column) {
    int parts = 0;
    for (Eigen::Index i = 0; i < 3; ++i) parts += basis.block(4 * i, column, 4, 1).norm() > 1e-12;
    return parts;
  };
  int mixed = 0;
  for (Eigen::Index j = 0; j < 6; ++j) {
    EXPECT_EQ(touches(T, j), 1);
    mixed += touches(constraints.null_basis(), j) > 1;
  }
  EXPECT_GT(mixed, 0) << "the basis of the factorization would do";
}

/// A held coordinate is in no column, and a free one is a column by itself.
TEST(SeparatedBasis, LeavesOutWhatIsHeld) {
  const ConstraintFactorization held{SystemMatrix(Matrix{{1.0, 0.0, 0.0}})};
  const Matrix T = separated_basis(held);
  ASSERT_EQ(T.cols(), 2);
  EXPECT_EQ(T.row(0).norm(), 0.0);
  EXPECT_LT((T.bottomRows(2).cwiseAbs() - Matrix::Identity(2, 2)).norm(), 1e-15);
  const ConstraintFactorization none{SystemMatrix(Matrix(0, 3))};
  EXPECT_LT((separated_basis(none).cwiseAbs() - Matrix::Identity(3, 3)).norm(), 1e-15);
}

/// Stiffness of the three parts by p, equal but for the factor of the last.
PlaceOnPath place(double p, double last) {
  const Matrix base = random_matrix(4, 4, 11);
  const Matrix one = Matrix::Identity(4, 4) + base.transpose() * base + p * Matrix(base + base.transpose());
  Matrix K = Matrix::Zero(12, 12);
  for (Eigen::Index i = 0; i < 3; ++i) K.block(4 * i, 4 * i, 4, 4) = (i == 2 ? last : 1.0) * one;
  return {Matrix::Identity(12, 12), Matrix::Zero(12, 12), K, constraints_of_three(p)};
}

TEST(TurnedFrame, HasTheSamePartsEverywhere) {
  const std::vector<PlaceOnPath> places{place(0.0, 1.0), place(0.11, 1.0), place(0.3, 1.0)};
  const auto parts = find_turning_parts(places);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->count(), 1U);
  ASSERT_EQ(parts->ranges[0].copies.size(), 2U);
  for (const double p : {0.05, 0.2, 0.29}) {  // no places where parts were looked for
    const PlaceOnPath there = place(p, 1.0);
    const auto here = turned(parts, there.constraints);
    ASSERT_TRUE(here);
    EXPECT_LT((here->inverse * here->right - Matrix::Identity(2, 2)).norm(), 1e-13);
    const Matrix own = here->left.transpose() * there.K * here->right;
    for (const PartCopy& copy : here->ranges[0].copies) {
      EXPECT_LT((there.constraints.allowed_part(copy.right) - copy.right).norm(), 1e-13);
      EXPECT_LT((copy.left.transpose() * there.K * copy.right - own).norm(), 1e-12 * own.norm());
      EXPECT_LT((copy.left.transpose() * there.K * here->right).norm(), 1e-12 * own.norm());
    }
  }
  const auto mistuned = find_turning_parts({place(0.0, 1.0 + 1e-9), place(0.11, 1.0 + 1e-9)});
  ASSERT_TRUE(mistuned);
  EXPECT_EQ(mistuned->count(), 2U);
}

TEST(TurnedFrame, IsNoneWhereTheTangentSpaceTurnsTooFar) {
  const auto place_at = [](double angle) {
    const Matrix A{{-std::sin(angle), 0.0, std::cos(angle)}};
    return PlaceOnPath{Matrix::Identity(3, 3), Matrix::Zero(3, 3), Vector{{1.0, 2.0, 1.0}}.asDiagonal(),
                       ConstraintFactorization(SystemMatrix(A))};
  };
  EXPECT_TRUE(find_turning_parts({place_at(0.0), place_at(1.3), place_at(2.6)}));
  EXPECT_FALSE(find_turning_parts({place_at(0.0), place_at(1.5), place_at(3.0)}));
}

}  // namespace
}  // namespace eigentrail::test::turned_frame_test
