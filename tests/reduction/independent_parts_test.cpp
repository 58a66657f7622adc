#include "eigentrail/reduction/independent_parts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "eigentrail/reduction/reduced_pencil.hpp"
#include "support/families.hpp"

namespace eigentrail::test::independent_parts_test {
namespace {

constexpr double rounding = 1e-11;

std::shared_ptr<const IndependentParts> parts_of(const std::vector<Matrix>& all) {
  return find_independent_parts({{all}, {}, {}});
}

/// Coordinates that are neither orthogonal nor close to singular.
Matrix mixing(Eigen::Index n, unsigned seed) {
  return 2.0 * Matrix::Identity(n, n) + 0.5 * random_matrix(n, n, seed);
}

Matrix orthogonal(Eigen::Index n, unsigned seed) {
  return random_matrix(n, n, seed).householderQr().householderQ() * Matrix::Identity(n, n);
}

Matrix side_by_side(const Matrix& A, const Matrix& B) {
  Matrix both = Matrix::Zero(A.rows() + B.rows(), A.cols() + B.cols());
  both.topLeftCorner(A.rows(), A.cols()) = A;
  both.bottomRightCorner(B.rows(), B.cols()) = B;
  return both;
}

/// Coordinates of all parts, every copy behind the part that it equals.
PartCopy with_copies(const IndependentParts& parts) {
  const Eigen::Index n = parts.right.rows();
  PartCopy all{Matrix(n, parts.freedoms()), Matrix(n, parts.freedoms()), Matrix(parts.freedoms(), n)};
  Eigen::Index at = 0;
  const auto add = [&](const Matrix& right, const Matrix& left, const Matrix& inverse) {
    all.right.middleCols(at, right.cols()) = right;
    all.left.middleCols(at, right.cols()) = left;
    all.inverse.middleRows(at, right.cols()) = inverse;
    at += right.cols();
  };
  for (std::size_t i = 0; i < parts.count(); ++i) {
    const auto& range = parts.ranges[i];
    add(parts.columns(i), parts.left.middleCols(range.first, range.size), parts.coordinates(i));
    for (const PartCopy& copy : range.copies) add(copy.right, copy.left, copy.inverse);
  }
  return all;
}

/// Sizes of all parts, copies included.
std::vector<Eigen::Index> sizes_of(const IndependentParts& parts) {
  std::vector<Eigen::Index> sizes;
  for (const auto& range : parts.ranges) sizes.insert(sizes.end(), 1 + range.copies.size(), range.size);
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

using Sizes = std::vector<Eigen::Index>;

/// Expects that the matrices are block diagonal in the new coordinates, and that these are coordinates.
void expect_parts(const std::vector<Matrix>& all, const Sizes& sizes) {
  const auto parts = parts_of(all);
  ASSERT_NE(parts, nullptr);
  EXPECT_EQ(sizes_of(*parts), sizes);
  const Eigen::Index n = all[0].rows();
  const PartCopy coordinates = with_copies(*parts);
  EXPECT_LT((coordinates.inverse * coordinates.right - Matrix::Identity(n, n)).norm(), rounding);
  for (const Matrix& A : all) {
    Matrix there = coordinates.left.transpose() * A * coordinates.right;
    const double size = coordinates.left.norm() * A.norm() * coordinates.right.norm();
    Eigen::Index at = 0;
    for (const auto& range : parts->ranges) {
      const Matrix own = there.block(at, at, range.size, range.size);
      for (std::size_t copy = 0; copy <= range.copies.size(); ++copy, at += range.size) {
        EXPECT_LT((there.block(at, at, range.size, range.size) - own).norm(), rounding * size);
        there.block(at, at, range.size, range.size).setZero();
      }
    }
    EXPECT_LT(there.norm(), rounding * size);
  }
}

/// Ziegler's column: mass, stiffness, follower load.
const Matrix ziegler_M{{3.0, 1.0}, {1.0, 1.0}};
const Matrix ziegler_K{{2.0, -1.0}, {-1.0, 1.0}};
const Matrix ziegler_P{{-1.0, 1.0}, {0.0, 0.0}};

std::vector<Matrix> columns_side_by_side(int count) {
  std::vector<Matrix> all{ziegler_M, ziegler_K, ziegler_P};
  for (int i = 1; i < count; ++i) {
    all[0] = side_by_side(all[0], ziegler_M);
    all[1] = side_by_side(all[1], ziegler_K);
    all[2] = side_by_side(all[2], ziegler_P);
  }
  return all;
}

/// In any coordinates of equations and unknowns, symmetric or not, one column stands for all.
TEST(IndependentParts, StandForTheirCopies) {
  for (const int count : {2, 3, 6}) {
    std::vector<Matrix> all = columns_side_by_side(count);
    const Matrix L = mixing(2 * count, 11);
    const Matrix R = mixing(2 * count, 12);
    for (Matrix& A : all) A = L * A * R;
    const auto parts = find_independent_parts({{all[0]}, {}, {all[1], all[2]}});
    ASSERT_NE(parts, nullptr);
    ASSERT_EQ(parts->count(), 1U);
    EXPECT_EQ(parts->ranges.front().copies.size(), static_cast<std::size_t>(count - 1));
    EXPECT_EQ(parts->right.cols(), 2);
    expect_parts(all, Sizes(static_cast<std::size_t>(count), 2));
  }
}

/// Larger parts, whose eigenvectors are complex with phases that say nothing.
TEST(IndependentParts, OfSeveralFreedomsHaveCopies) {
  for (const Eigen::Index size : {3, 5, 8}) {
    std::vector<Matrix> all;
    const Matrix Q = orthogonal(3 * size, 9);
    for (unsigned k = 0; k < 4; ++k) {
      const Matrix A =
          random_matrix(size, size, 30 + k) + (k == 0 ? 4.0 : 0.0) * Matrix::Identity(size, size);
      all.emplace_back(Q.transpose() * side_by_side(side_by_side(A, A), A) * Q);
    }
    const auto parts = find_independent_parts({{all[0]}, {all[1]}, {all[2], all[3]}});
    ASSERT_NE(parts, nullptr);
    ASSERT_EQ(parts->count(), 1U) << size;
    EXPECT_EQ(parts->ranges.front().copies.size(), 2U);
  }
}

/// Mistuning of 1e-10 makes parts of their own; of 1e-16 it is rounding.
TEST(IndependentParts, ThatAreMistunedAreNoCopies) {
  const auto copies = [](double mistuning) {
    const Matrix K = side_by_side(ziegler_K, (1.0 + mistuning) * ziegler_K);
    const auto parts = find_independent_parts(
        {{side_by_side(ziegler_M, ziegler_M)}, {}, {K, side_by_side(ziegler_P, ziegler_P)}});
    EXPECT_EQ(parts->freedoms(), 4);
    return parts->ranges.front().copies.size();
  };
  EXPECT_EQ(copies(1e-10), 0U);
  EXPECT_EQ(copies(1e-8), 0U);
  EXPECT_EQ(copies(1e-16), 1U);
}

TEST(IndependentParts, OfDifferentUnsymmetricPartsAreFoundInAnyCoordinates) {
  const Matrix L = mixing(7, 1);
  const Matrix R = mixing(7, 2);
  std::vector<Matrix> all;
  for (unsigned k = 0; k < 4; ++k) {
    const Matrix blocks = side_by_side(random_matrix(4, 4, 10 + k), random_matrix(3, 3, 20 + k));
    all.emplace_back(L * blocks * R);
  }
  expect_parts(all, {3, 4});
}

TEST(IndependentParts, OfARingOfBladesAreItsHarmonics) {
  // Coupled to the neighbours: all matrices commute, and every harmonic is a freedom of its own.
  constexpr Eigen::Index n = 9;
  const Matrix I = Matrix::Identity(n, n);
  Matrix shift = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) shift(i, (i + 1) % n) = 1.0;
  const Matrix ring = 2.0 * I - shift - shift.transpose();
  expect_parts({I, ring}, Sizes(n, 1));
  // With gyroscopic coupling, a harmonic and its opposite are a complex pair: one real part of two.
  expect_parts({I, ring, shift - shift.transpose()}, {1, 2, 2, 2, 2});
}

TEST(IndependentParts, KeepSymmetryAndSkewSymmetry) {
  const Matrix Q = mixing(6, 4);
  const auto symmetric = [](const Matrix& A) { return Matrix(A * A.transpose()); };
  const auto skew = [](const Matrix& A) { return Matrix(A - A.transpose()); };
  const Matrix M = side_by_side(symmetric(random_matrix(3, 3, 1)), symmetric(random_matrix(3, 3, 2)));
  const Matrix K = side_by_side(symmetric(random_matrix(3, 3, 3)), symmetric(random_matrix(3, 3, 4)));
  const Matrix G = side_by_side(skew(random_matrix(3, 3, 5)), skew(random_matrix(3, 3, 6)));
  const std::vector<Matrix> all{Q.transpose() * M * Q, Q.transpose() * K * Q, Q.transpose() * G * Q};
  expect_parts(all, {3, 3});
  const auto parts = parts_of(all);
  EXPECT_EQ(parts->left, parts->right);
}

/// Two equal oscillators that a coupling c and a mistuning m tie together.
std::vector<Matrix> nearly_equal(double c, double m) {
  return {Matrix::Identity(2, 2), Matrix{{1.0, c}, {c, 1.0 + m}}, Matrix{{0.1, 0.0}, {0.0, 0.3}}};
}

TEST(IndependentParts, AreNotSeparatedWhereACouplingIsAboveRounding) {
  EXPECT_EQ(parts_of(nearly_equal(0.1, 0.0)), nullptr);
  EXPECT_EQ(parts_of(nearly_equal(1e-9, 1e-10)), nullptr);
  expect_parts(nearly_equal(0.0, 1e-10), {1, 1});  // mistuned, but not coupled
  // A coupling that is given is no rounding, however weak: it makes a veering, and no crossing.
  EXPECT_EQ(parts_of(nearly_equal(1e-12, 0.0)), nullptr);
  EXPECT_EQ(parts_of(nearly_equal(1e-15, 0.0)), nullptr);
}

TEST(IndependentParts, OfAFamilyThatIsCoupledAreNone) {
  EXPECT_EQ(parts_of({random_matrix(5, 5, 1), random_matrix(5, 5, 2), random_matrix(5, 5, 3)}), nullptr);
  EXPECT_EQ(parts_of({ziegler_M, ziegler_K, ziegler_P}), nullptr);
  EXPECT_EQ(parts_of({}), nullptr);
  EXPECT_EQ(parts_of({Matrix::Identity(1, 1)}), nullptr);
}

/// A Jordan block beside another freedom: its eigenvectors are no basis, and nothing must be invented.
TEST(IndependentParts, OfADefectiveFamilyAreNone) {
  const Matrix J{{1.0, 1.0, 0.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}};
  EXPECT_EQ(parts_of({Matrix::Identity(3, 3), J}), nullptr);
}

/// Three masses on two springs, one of which changes: their common motion is a part without stiffness.
TEST(IndependentParts, HaveZerosWhereEntriesAreRoundingThroughout) {
  const Matrix a{{1.0, -1.0, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
  const Matrix b{{0.0, 0.0, 0.0}, {0.0, 1.0, -1.0}, {0.0, -1.0, 1.0}};
  const auto parts = find_independent_parts({{Matrix::Identity(3, 3)}, {}, {a, b}});
  ASSERT_NE(parts, nullptr);
  EXPECT_EQ(sizes_of(*parts), (Sizes{1, 2}));
  Linearization linearization;
  linearization.M = {Matrix(Matrix::Identity(3, 3))};
  linearization.C = {Matrix(Matrix::Zero(3, 3))};
  linearization.K = {Matrix(a + 0.7 * b), b};
  const ReducedPencil pencil = reduce(linearization, basis_of(parts), 1);
  const int rigid = parts->ranges[0].size == 1 ? 0 : 1;
  EXPECT_EQ(pencil.of(rigid).K[0](0, 0), 0.0);
  EXPECT_GT(pencil.of(rigid).M[0](0, 0), 0.0);
}

/// Two masses that nothing holds beside an oscillator, in mixed coordinates: the two free motions have simple
/// coordinates in which the mass is diagonal.
TEST(IndependentParts, OfFreeMotionsAreSimple) {
  const Matrix M{{2.0, 0.5, 0.0}, {0.5, 3.0, 0.0}, {0.0, 0.0, 1.0}};
  const Matrix K{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}};
  const auto parts = find_independent_parts({{M}, {}, {K}});
  ASSERT_NE(parts, nullptr);
  EXPECT_EQ(sizes_of(*parts), (Sizes{1, 1, 1}));
  EXPECT_LT((parts->inverse * parts->right - Matrix::Identity(3, 3)).norm(), rounding);
  const Matrix mass = parts->left.transpose() * M * parts->right;
  EXPECT_LT((mass - Matrix(mass.diagonal().asDiagonal())).norm(), rounding * mass.norm());
  int simple = 0;
  for (const auto& motion : parts->right.colwise()) simple += (motion.array() != 0.0).count() == 1 ? 1 : 0;
  EXPECT_EQ(simple, 2);  // one free motion and the oscillator; the other free motion has to be independent
}

/// Freedoms without forces do not spoil the scaling of the others.
TEST(IndependentParts, OfFreeMotionsHaveAScale) {
  const Matrix M = Eigen::Vector3d(2.0, 3.0, 5.0).asDiagonal();
  const Matrix K{{1000.0, -1000.0, 0.0}, {-1000.0, 1000.0, 0.0}, {0.0, 0.0, 0.0}};
  const auto parts = find_independent_parts({{M}, {}, {K}});
  ASSERT_NE(parts, nullptr);
  EXPECT_LT(parts->right.cwiseAbs().maxCoeff(), 1e3);
  EXPECT_GT(parts->right.colwise().norm().minCoeff(), 1e-3);
}

TEST(IndependentParts, BalanceUnits) {
  // Metres beside micrometres: the entries differ by a million and more.
  const Matrix M{{2.0, 0.3}, {0.3, 1.0}};
  const Matrix K{{5.0, -2.0}, {-2.0, 7.0}};
  const Matrix C{{0.1, 0.4}, {-0.2, 0.3}};
  EXPECT_EQ(parts_of({M, K, C}), nullptr) << "in like units nothing is to be done";
  const Vector units{{1.0, 1e6}};
  const auto in = [&](const Matrix& A) { return Matrix(units.asDiagonal() * A * units.asDiagonal()); };
  const auto parts = parts_of({in(M), in(K), in(C)});
  ASSERT_NE(parts, nullptr);
  EXPECT_TRUE(parts->is_diagonal);
  EXPECT_EQ(parts->count(), 1U);
  const Matrix balanced = parts->left.transpose() * in(K)*parts->right;
  EXPECT_LT(balanced.cwiseAbs().maxCoeff() / balanced.cwiseAbs().minCoeff(), 10.0);
  const double exponent = std::log2(parts->right(1, 1));
  EXPECT_EQ(exponent, std::round(exponent)) << "powers of two change no digit";
  const ComplexMatrix Z = ComplexMatrix::Random(2, 3);
  const TangentBasis basis = basis_of(parts);
  EXPECT_EQ(basis.shapes(Z, 0), ComplexMatrix(parts->right * Z));
  EXPECT_EQ(basis.coordinates(basis.shapes(Z, 0), 0), Z);
}

}  // namespace
}  // namespace eigentrail::test::independent_parts_test
