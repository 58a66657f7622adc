#include "eigentrail/reduction/independent_parts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {
namespace {

constexpr double rounding = 1e-11;

std::shared_ptr<const IndependentParts> parts_of(const std::vector<Matrix>& all) {
  return find_independent_parts({{all}, {}, {}});
}

Matrix random_matrix(Eigen::Index n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(n, n, [&] { return normal(engine); });
}

/// Coordinates that are neither orthogonal nor close to singular.
Matrix mixing(Eigen::Index n, unsigned seed) {
  return 2.0 * Matrix::Identity(n, n) + 0.5 * random_matrix(n, seed);
}

Matrix orthogonal(Eigen::Index n, unsigned seed) {
  return random_matrix(n, seed).householderQr().householderQ() * Matrix::Identity(n, n);
}

Matrix side_by_side(const Matrix& A, const Matrix& B) {
  Matrix both = Matrix::Zero(A.rows() + B.rows(), A.cols() + B.cols());
  both.topLeftCorner(A.rows(), A.cols()) = A;
  both.bottomRightCorner(B.rows(), B.cols()) = B;
  return both;
}

std::vector<Eigen::Index> sizes_of(const IndependentParts& parts) {
  std::vector<Eigen::Index> sizes;
  for (const auto& range : parts.ranges) sizes.push_back(range.size);
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
  EXPECT_LT((parts->inverse * parts->right - Matrix::Identity(n, n)).norm(), rounding);
  for (const Matrix& A : all) {
    Matrix there = parts->left.transpose() * A * parts->right;
    const double size = parts->left.norm() * A.norm() * parts->right.norm();
    for (const auto& range : parts->ranges)
      there.block(range.first, range.first, range.size, range.size).setZero();
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

TEST(IndependentParts, OfEqualColumnsAreTheColumns) {
  for (const int count : {2, 3, 4, 6}) {
    std::vector<Matrix> all = columns_side_by_side(count);
    expect_parts(all, Sizes(static_cast<std::size_t>(count), 2));
    const Matrix Q = orthogonal(2 * count, 5);
    for (Matrix& A : all) A = Q.transpose() * A * Q;
    expect_parts(all, Sizes(static_cast<std::size_t>(count), 2));
  }
}

TEST(IndependentParts, OfDifferentUnsymmetricPartsAreFoundInAnyCoordinates) {
  const Matrix L = mixing(7, 1);
  const Matrix R = mixing(7, 2);
  std::vector<Matrix> all;
  for (unsigned k = 0; k < 4; ++k) {
    const Matrix blocks = side_by_side(random_matrix(4, 10 + k), random_matrix(3, 20 + k));
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
  const Matrix M = side_by_side(symmetric(random_matrix(3, 1)), symmetric(random_matrix(3, 2)));
  const Matrix K = side_by_side(symmetric(random_matrix(3, 3)), symmetric(random_matrix(3, 4)));
  const Matrix G = side_by_side(skew(random_matrix(3, 5)), skew(random_matrix(3, 6)));
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
  EXPECT_EQ(parts_of({random_matrix(5, 1), random_matrix(5, 2), random_matrix(5, 3)}), nullptr);
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

TEST(IndependentParts, OfAPencilHaveItsEigenvalues) {
  const std::vector<Matrix> all = columns_side_by_side(3);
  const Matrix Q = mixing(6, 8);
  Linearization linearization;
  linearization.M = {Matrix(Q.transpose() * all[0] * Q)};
  linearization.C = {Matrix(Matrix::Zero(6, 6))};
  linearization.K = {Matrix(Q.transpose() * (all[1] + 0.7 * all[2]) * Q), Matrix(Q.transpose() * all[2] * Q)};
  const auto mixed = [&](const Matrix& A) { return Matrix(Q.transpose() * A * Q); };
  const auto parts = find_independent_parts({{mixed(all[0])}, {}, {mixed(all[1]), mixed(all[2])}});
  ASSERT_NE(parts, nullptr);
  const ReducedPencil pencil = reduce(linearization, basis_of(parts), 3);
  ASSERT_EQ(pencil.parts.size(), 3U);
  const auto squares = [](const Matrix& M, const Matrix& K) {
    ComplexVector values = Eigen::EigenSolver<Matrix>(Matrix(M.inverse() * K), false).eigenvalues();
    std::sort(values.begin(), values.end(), [](Complex a, Complex b) { return a.real() < b.real(); });
    return values;
  };
  const ComplexVector one = squares(ziegler_M, ziegler_K + 0.7 * ziegler_P);
  for (int i = 0; i < 3; ++i) {
    const ReducedPencil& own = pencil.of(i);
    EXPECT_LT((squares(own.M[0], own.K[0]) - one).norm(), rounding);
    EXPECT_EQ(own.K.size(), 2U);
  }
}

}  // namespace
}  // namespace eigentrail
