// Modes of small pencils, sums of sparse matrices, and the indicator of the error of a projection.
#include "projection/projection_error.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "projection/family_pencils.hpp"
#include "support/large_families.hpp"

namespace eigentrail::test::projection_error_test {
namespace {

/// Damped, gyroscopic and circulatory: left vectors are not right ones.
SmallPencil circulatory_pencil() {
  SmallPencil small{Matrix::Identity(3, 3), Matrix::Zero(3, 3), Matrix::Zero(3, 3)};
  small.C << 0.1, 0.4, 0.0, -0.4, 0.2, 0.1, 0.0, 0.1, 0.3;
  small.K << 2.0, 0.7, 0.1, -0.5, 5.0, 0.3, 0.0, -0.2, 9.0;
  return small;
}

ComplexMatrix at(const SmallPencil& small, Complex s) {
  return s * s * small.M + s * small.C + small.K;
}

TEST(SmallPencils, RoughEigenvaluesAreRefinedWithBothVectors) {
  const SmallPencil small = circulatory_pencil();
  // By the eigenvalues of [0 1; -K -C], with NumPy.
  for (const Complex exact :
       {Complex(-0.123150382544776, 1.410931326948329), Complex(-0.025062113596449, 2.277517169724337),
        Complex(-0.151787503858775, 2.990154160713652)}) {
    const RefinedMode refined =
        refined_mode(small, exact * Complex(1.0 + 1e-3, -1e-3), ComplexVector::Ones(3));
    EXPECT_TRUE(refined.is_settled);
    const ProjectedMode& mode = refined.mode;
    EXPECT_LT(std::abs(mode.s - exact), 1e-13 * std::abs(exact));
    EXPECT_LT((at(small, mode.s) * mode.right).norm(), 1e-9);
    EXPECT_LT((mode.left.transpose() * at(small, mode.s)).norm(), 1e-9);
    EXPECT_GT((mode.right.transpose() * at(small, mode.s)).norm(), 1e-2);  // right vectors are no left ones
    EXPECT_NEAR(mode.right.norm(), 1.0, 1e-14);
  }
}

TEST(SmallPencils, AValueFarFromAllEigenvaluesStaysWithItsShape) {
  const ComplexVector shape = ComplexVector::Unit(3, 1);
  const Complex far(0.0, 1.9);
  const RefinedMode refined = refined_mode(circulatory_pencil(), far, shape);
  EXPECT_EQ(refined.mode.s, far);
  EXPECT_EQ(refined.mode.right, shape);
  EXPECT_FALSE(refined.is_settled);
}

TEST(SmallPencils, ADoubleEigenvalueDoesNotSettle) {
  // Two masses, the first with critical damping: s = -1 twice.
  SmallPencil small{Matrix::Identity(2, 2), Matrix::Zero(2, 2), Matrix::Identity(2, 2)};
  small.C(0, 0) = 2.0;
  small.K(1, 1) = 9.0;
  EXPECT_FALSE(refined_mode(small, -1.001, {}).is_settled);
  EXPECT_TRUE(refined_mode(small, Complex(0.01, 3.001), {}).is_settled);
}

const SparseFamily& family_of(const TraceSetup& setup) {
  return dynamic_cast<const SparseFamily&>(*setup.model);
}

TEST(FamilyPencils, AreThoseOfTheFamilyWithOnePattern) {
  const TraceSetup setup = large_setup(rotating_plate({8, 0.02, 0.3, 10.0}), 0.0, 2.0, 4, 1e-6);
  const FamilyPencils pencils(family_of(setup));
  const SparsePencil rest = pencils.at(Vector::Constant(1, 0.0));
  for (const double omega : {0.0, 0.7, 2.0}) {
    const AffinePencil<SparseMatrix> expected = family_of(setup).at(Vector::Constant(1, omega));
    const SparsePencil pencil = pencils.at(Vector::Constant(1, omega));
    EXPECT_EQ((pencil.M - expected.M.front().matrix).norm(), 0.0);
    EXPECT_LT((pencil.C - expected.C.front().matrix).norm(), 1e-15 * pencil.C.norm());
    EXPECT_LT((pencil.K - expected.K.front().matrix).norm(), 1e-15 * pencil.K.norm());
    EXPECT_EQ(pencil.K.nonZeros(), rest.K.nonZeros());
    EXPECT_EQ(pencil.C.nonZeros(), rest.C.nonZeros());
  }
}

TEST(FamilyPencils, ProjectionsAreCongruencesAndKeepSymmetry) {
  const TraceSetup setup = large_setup(rotating_plate({8, 0.02, 0.3, 10.0}), 0.0, 2.0, 4, 1e-6);
  const AffinePencil<SparseMatrix>& large = family_of(setup).pencil();
  const Matrix Q = Matrix::NullaryExpr(128, 37, [](Eigen::Index i, Eigen::Index j) {
    return std::cos(static_cast<double>((i + 1) * (2 * j + 1)));
  });
  const AffinePencil<Matrix> small = FamilyPencils(family_of(setup)).projected(Q);
  for (std::size_t i = 0; i < large.K.size(); ++i) {
    const Matrix expected = Q.transpose() * Matrix(large.K[i].matrix) * Q;
    EXPECT_LT((small.K[i].matrix - expected).norm(), 1e-13 * expected.norm()) << i;
  }
  EXPECT_EQ(small.K[0].matrix, Matrix(small.K[0].matrix.transpose()));
  EXPECT_EQ(small.C[0].matrix, Matrix(-small.C[0].matrix.transpose()));  // gyroscopic
}

/// The indicator is of second order: vectors that are wrong by e give e^2, where both are.
TEST(ProjectionErrors, AreOfSecondOrderInBothVectors) {
  const TraceSetup setup = large_setup(rotating_plate({8, 0.02, 0.0, 10.0}), 0.0, 2.0, 4, 1e-6);
  const SparsePencil pencil = FamilyPencils(family_of(setup)).at(Vector::Constant(1, 1.0));
  ASSERT_FALSE(pencil.one_sided);
  const SmallPencil dense{Matrix(pencil.M), Matrix(pencil.C), Matrix(pencil.K)};
  const Complex near = eigenvalues_near(family_of(setup).at(Vector::Constant(1, 1.0)), {0.0, 5.0}, 1).front();
  const ProjectedMode exact = mode_of(dense, near);
  EXPECT_LT(eigenvalue_errors(pencil, {exact}).front().distance, 1e-9);
  std::array<double, 3> both{}, one{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = std::pow(10.0, -2.0 - static_cast<double>(i));
    ProjectedMode rough = exact;
    rough.right += e * ComplexVector::Constant(128, Complex(0.1, 0.05));
    one[i] = eigenvalue_errors(pencil, {exact, rough}).back().distance;
    rough.left += e * ComplexVector::Constant(128, Complex(0.05, 0.1));
    both[i] = eigenvalue_errors(pencil, {exact, rough}).back().distance;
  }
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    EXPECT_NEAR(std::log10(both[i] / both[i + 1]), 2.0, 0.1) << i;
    EXPECT_LT(one[i], 1e-6 * both[0]) << i;  // an exact left vector leaves no error
  }
}

}  // namespace
}  // namespace eigentrail::test::projection_error_test
