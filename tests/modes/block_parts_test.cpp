#include "eigentrail/modes/block_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/modes/invariants.hpp"
#include "modes/turning_basis.hpp"

namespace eigentrail::test::block_parts_test {
namespace {

constexpr std::size_t count = 6;  ///< coefficients

/// Two eigenvalues i +- sqrt(h + 1e-9 h^2), defective at h = 0, beside two others at 2i + h and 3i - h.
std::vector<ComplexMatrix> with_exceptional_point() {
  const Complex i(0.0, 1.0);
  std::vector<ComplexMatrix> D(3, ComplexMatrix::Zero(4, 4));
  D[0].diagonal() << i, i, 2.0 * i, 3.0 * i;
  D[0](0, 1) = 1.0;
  D[1](1, 0) = 1.0;
  D[1](2, 2) = 1.0;
  D[1](3, 3) = -1.0;
  D[2](1, 0) = 1e-9;
  return in_turning_basis(D, count, 3);
}

TEST(PartSeries, TellsAGapThroughAnExceptionalPointToFullAccuracy) {
  const Complex i(0.0, 1.0);
  const std::vector<ComplexMatrix> Lambda = with_exceptional_point();
  const std::vector<ComplexMatrix> part = part_series(Lambda, {i, i});
  ASSERT_EQ(part.size(), count);
  const ComplexVector gap = discriminant_series(part, 1);
  ComplexVector exact = ComplexVector::Zero(count);
  exact[1] = 1.0;
  exact[2] = 1e-9;
  EXPECT_LT((gap - exact).norm(), 1e-13);
  EXPECT_LT((mean_series(part) - i * ComplexVector::Unit(count, 0)).norm(), 1e-13);
  // The eigenvalues themselves have no power series there and are accurate only to the square root of
  // rounding.
  const ComplexVector roots = block_roots(Lambda[0].reshaped());
  EXPECT_GT((in_order_of((ComplexVector(4) << i, i, 2.0 * i, 3.0 * i).finished(), roots).head(2).array() - i)
                .abs()
                .maxCoeff(),
            1e-9)
      << "the rival did not lose";
}

TEST(PartSeries, OfOneEigenvalueIsItsSeries) {
  const ComplexVector series = mean_series(part_series(with_exceptional_point(), {Complex(0.0, 3.0)}));
  ComplexVector exact = ComplexVector::Zero(count);
  exact[0] = Complex(0.0, 3.0);
  exact[1] = -1.0;
  EXPECT_LT((series - exact).norm(), 1e-13);
}

TEST(PartSeries, OfAllIsTheBlock) {
  const std::vector<ComplexMatrix> Lambda = with_exceptional_point();
  EXPECT_EQ(part_series(Lambda, {0.0, 0.0, 0.0, 0.0})[1], Lambda[1]);
}

TEST(PartSeries, OfOneOfTwoThatCoincideIsEmpty) {
  std::vector<ComplexMatrix> D(2, ComplexMatrix::Zero(3, 3));
  D[0].diagonal() << 1.0, 1.0, 2.0;
  D[1].diagonal() << 1.0, -1.0, 0.0;
  EXPECT_TRUE(part_series(D, {1.0}).empty());
}

TEST(GapSeries, OfAPermanentDoubletAndAThird) {
  // Doublet at i, third at i + h: ((s_a - s_b) / 2)^2 = h^2 / 4.
  std::vector<ComplexMatrix> D(2, ComplexMatrix::Zero(3, 3));
  D[0].diagonal().setConstant(Complex(0.0, 1.0));
  D[1](2, 2) = 1.0;
  const ComplexVector gap = discriminant_series(in_turning_basis(D, count, 8), 2);
  EXPECT_LT(std::abs(gap[2] - 0.25), 1e-13);
  EXPECT_LT(gap.head(2).norm() + gap.tail(3).norm(), 1e-13);
}

TEST(GapSeries, FromBothSeriesIsHalfTheirDifferenceSquared) {
  const ComplexVector a{{3.0, 1.0, 0.0}};
  const ComplexVector b{{1.0, -1.0, 2.0}};
  const ComplexVector exact{{1.0, 2.0, -1.0}};
  EXPECT_LT((discriminant_series(a, b) - exact).norm(), 1e-14);
}

}  // namespace
}  // namespace eigentrail::test::block_parts_test
