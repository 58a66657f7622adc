// Common null vectors of M, C and K, freedoms on which no mass, damping and stiffness acts, are found
// whatever combination of coordinates they are. No other freedoms are reported.
#include "continuation/point/common_null_vector.hpp"

#include <gtest/gtest.h>

#include <random>

#include "continuation/planted_points.hpp"
#include "support/families.hpp"

namespace eigentrail::test::common_null_vector_test {
namespace {

std::string coordinate_of(const Matrix& M, const Matrix& C, const Matrix& K,
                          const std::vector<Matrix>& A = {}) {
  Planted family({{M}, {C}, {K}, A});
  return null_vector_coordinate(family.model(), family.reduced(0.0));
}

Matrix diagonal(const Vector& entries) {
  return entries.asDiagonal();
}

/// Springs between neighbours only: nothing holds the chain.
Matrix free_chain(Eigen::Index n) {
  Matrix K = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    K(i, i) += 1.0;
    K(i + 1, i + 1) += 1.0;
    K(i, i + 1) -= 1.0;
    K(i + 1, i) -= 1.0;
  }
  return K;
}

const Matrix none = Matrix::Zero(3, 3);
const Matrix unit = Matrix::Identity(3, 3);

TEST(NullVectorCoordinate, OneMatrixIsEnoughToKeepAFreedom) {
  const Matrix two = diagonal(Vector{{1.0, 1.0, 0.0}});
  const Matrix third = diagonal(Vector{{0.0, 0.0, 1.0}});
  EXPECT_EQ(coordinate_of(third, two, none), "");
  EXPECT_EQ(coordinate_of(two, third, two), "");
  EXPECT_EQ(coordinate_of(two, none, third), "");
}

/// The rigid-body motion has mass but no stiffness. A test of K alone would report it as idle.
TEST(NullVectorCoordinate, FreeChainHasNone) {
  const Matrix K = free_chain(3);
  EXPECT_EQ(coordinate_of(unit, none, K), "");
  // One mass anywhere is enough.
  EXPECT_EQ(coordinate_of(diagonal(Vector{{0.0, 0.0, 1.0}}), none, K), "");
}

TEST(NullVectorCoordinate, MasslessFreeChainMovesAsAWhole) {
  EXPECT_NE(coordinate_of(none, free_chain(3), free_chain(3)), "");
}

/// No row and no diagonal entry vanishes. A test for zero rows would find nothing.
TEST(NullVectorCoordinate, OfACombinationIsTheOneThatMovesMost) {
  // Every matrix takes (0.3, 1, -0.2) to zero.
  const Vector idle{{0.3, 1.0, -0.2}};
  const Matrix P = Matrix::Identity(3, 3) - idle * idle.transpose() / idle.squaredNorm();
  std::mt19937_64 engine(7);
  const auto blind = [&] { return Matrix(P * random_matrix(3, 3, engine) * P); };
  const Matrix M = blind();
  for (Eigen::Index i = 0; i < 3; ++i) ASSERT_GT(M.row(i).norm(), 0.01);
  EXPECT_EQ(coordinate_of(M, blind(), blind()), "x2");
}

TEST(NullVectorCoordinate, UnitsOfTheMatricesDoNotMatter) {
  // Masses of 1e-9, stiffnesses of 1e9: the third freedom has a mass of the usual size, for a mass.
  const Matrix M = diagonal(Vector{{1e-9, 1e-9, 1e-9}});
  const Matrix K = diagonal(Vector{{1e9, 1e9, 0.0}});
  EXPECT_EQ(coordinate_of(M, none, K), "");
  EXPECT_EQ(coordinate_of(diagonal(Vector{{1e-9, 1e-9, 0.0}}), none, K), "x3");
}

TEST(NullVectorCoordinate, SmallIsNotZeroButRoundingIs) {
  EXPECT_EQ(coordinate_of(diagonal(Vector{{1.0, 1.0, 1e-9}}), none, diagonal(Vector{{1.0, 1.0, 0.0}})), "");
  EXPECT_EQ(coordinate_of(diagonal(Vector{{1.0, 1.0, 1e-15}}), none, diagonal(Vector{{1.0, 1.0, 0.0}})),
            "x3");
}

TEST(NullVectorCoordinate, ThatIsConstrainedAwayIsNone) {
  const Matrix some = diagonal(Vector{{1.0, 0.0, 2.0}});
  EXPECT_EQ(coordinate_of(some, none, some, {Matrix{{0.0, 1.0, 0.0}}}), "");
  // Another constraint leaves it.
  EXPECT_EQ(coordinate_of(some, none, some, {Matrix{{1.0, 0.0, 1.0}}}), "x2");
  // Tied to a freedom with mass it moves with that.
  EXPECT_EQ(coordinate_of(some, none, some, {Matrix{{1.0, -1.0, 0.0}}}), "");
}

TEST(NullVectorCoordinate, WithoutFreedomsThereIsNone) {
  EXPECT_EQ(coordinate_of(none, none, none, {unit}), "");
}

/// det(s^2 M + s C + K) = 0 for every s, although no motion is in the null spaces of all three matrices.
TEST(NullVectorCoordinate, IsNoOtherSingularPencil) {
  const Matrix C{{0.0, 1.0}, {0.0, 0.0}};
  const Matrix K{{1.0, 0.0}, {0.0, 0.0}};
  EXPECT_EQ(coordinate_of(Matrix::Zero(2, 2), C, K), "");
}

TEST(NullVectorCoordinate, OfManyIsOneOfThem) {
  constexpr Eigen::Index n = 40;
  Vector entries = Vector::Ones(n);
  entries[11] = entries[29] = 0.0;
  const std::string found = coordinate_of(diagonal(entries), Matrix::Zero(n, n), diagonal(entries));
  EXPECT_TRUE(found == "x12" || found == "x30") << found;
}

/// A thin rod has no inertia about its own axis: that its hinges let it spin is idle.
TEST(NullVectorCoordinate, OfAThinRodIsItsSpin) {
  const auto scene = [](const std::string& inertia) {
    return make_setting(
        "[parameters]\nk = 2\n[trace]\nparameter = \"k\"\nfrom = 1\nto = 2\n" +
        ("[[body]]\nname = \"rod\"\nmass = 1\nposition = [0, 0, 0]\ninertia = " + inertia) +
        "\n[[spring]]\nfrom = [-1, 0, 0]\nto = \"rod\"\nstiffness = \"k\"\nfree_length = 1\n");
  };
  const auto idle_in = [](const Setting& setting) {
    RunCounts counts;
    const PathProblem problem = setting.problem();
    const Vector guess = setting.model->initial_guess(parameters_at(problem, 1.0));
    return null_vector_coordinate(*setting.model,
                                  reduce_at(problem, 1.0, {guess, Vector()}, Matrix(), counts));
  };
  EXPECT_EQ(idle_in(scene("[0.1, 1, 1]")), "");
  EXPECT_EQ(idle_in(scene("[0, 1, 1]")).substr(0, 3), "rod");
}

}  // namespace
}  // namespace eigentrail::test::common_null_vector_test
