// Projections on a space of right vectors and one of left vectors.
#include "projection/projection_space.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/projection/project.hpp"
#include "support/large_families.hpp"

namespace eigentrail::test::two_spaces_test {
namespace {

/// A space of eight dimensions with the columns of both as its vectors.
ProjectionSpace space_of(const Matrix& right, const Matrix& left) {
  ProjectionSpace space(8);
  space.add(right.cast<Complex>(), Side::right);
  space.add(left.cast<Complex>(), Side::left);
  return space;
}

/// How much of unit vectors is outside of the space of the columns of B, which are orthonormal.
double outside(const Matrix& B, const Matrix& vectors) {
  return (vectors - B * (B.transpose() * vectors)).colwise().norm().maxCoeff();
}

double least_singular_value(const Matrix& A) {
  return Eigen::JacobiSVD<Matrix>(A).singularValues().minCoeff();
}

TEST(TwoSpaces, OfTheSameVectorsAreOne) {
  const Matrix vectors = Matrix::Identity(8, 3);
  const ProjectionSpace space = space_of(vectors, vectors);
  const Matrix one = Matrix::Identity(space.basis().cols(), space.basis().cols());
  const TwoSpaces two = two_spaces(space, one, 1e-3);
  EXPECT_EQ(two.right.cols(), 3);
  EXPECT_LT(outside(two.right, two.left), 1e-14);
  EXPECT_LT(outside(space.basis() * two.right, vectors), 1e-14);
}

/// Where no right vector has a part in the space of left ones, W^T V would be zero.
TEST(TwoSpaces, GetTheVectorsOfTheOtherWhereTheyAreOrthogonal) {
  const Matrix all = Matrix::Identity(8, 4);
  const Matrix right = all.leftCols(2);
  Matrix left = all.rightCols(2);
  left.col(0) = (all.col(0) + 0.5 * all.col(2)).normalized();  // 27 degrees from the first right one
  const ProjectionSpace space = space_of(right, left);
  const Matrix one = Matrix::Identity(space.basis().cols(), space.basis().cols());
  const TwoSpaces two = two_spaces(space, one, 1e-3);
  EXPECT_EQ(two.right.cols(), 3);
  EXPECT_EQ(two.left.cols(), 3);
  EXPECT_LT(outside(space.basis() * two.right, right), 1e-14);
  EXPECT_LT(outside(space.basis() * two.left, left), 1e-14);
  EXPECT_GT(least_singular_value(two.left.transpose() * two.right), 0.1);
}

TEST(TwoSpaces, LeaveOutWhatVectorsOfTheirSideDoNotNeed) {
  const Matrix all = Matrix::Identity(8, 3);
  Matrix right = all.leftCols(2), left = all.leftCols(2);
  right.col(1) = (all.col(0) + 1e-5 * all.col(1)).normalized();
  left.col(1) = (all.col(0) + 1e-5 * all.col(2)).normalized();
  const ProjectionSpace space = space_of(right, left);
  const Matrix one = Matrix::Identity(space.basis().cols(), space.basis().cols());
  EXPECT_EQ(two_spaces(space, one, 1e-3).right.cols(), 1);
  EXPECT_GT(two_spaces(space, one, 1e-7).right.cols(), 1);
}

/// A circulatory plate on one space of all vectors has 75 coordinates.
TEST(TwoSpaces, MakeTheProjectionOfACirculatoryPlateSmaller) {
  RotatingPlate plate;
  plate.convection = 10.0;
  const TraceSetup setup = large_setup(rotating_plate(plate), 0.0, 2.0, 6, 1e-6);
  const auto model = projected_family(setup, setup.options);
  EXPECT_LE(model->n_coordinates(), 60);
  EXPECT_EQ(model->projection()->basis.cols(), model->n_coordinates());
  EXPECT_LE(model->projection()->factorizations, 5);
  for (const double p : {0.13, 0.4, 0.71, 1.0, 1.27, 1.6, 1.9}) {
    const Vector at = Vector::Constant(1, p);
    const AffinePencil<Matrix> small = model->at(at);
    const AffinePencil<SparseMatrix> large = dynamic_cast<const SparseFamily&>(*setup.model).at(at);
    const Spectrum spectrum =
        compute_eigenvalues(small.M.front().matrix, small.C.front().matrix, small.K.front().matrix);
    for (std::size_t i = 0; i < 6; ++i) {
      const Complex s = spectrum.modes[i].s;
      const Complex exact = eigenvalues_near(large, s * Complex(1.0 + 1e-5, 1e-5), 1).front();
      EXPECT_LT(std::abs(s - exact), 1e-8 * std::abs(s)) << p;
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::two_spaces_test
