#include "eigentrail/modes/invariants.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "eigentrail/modes/block_parts.hpp"
#include "modes/turning_basis.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::invariants_test {
namespace {

// Some ten roundings of terms of the size of the result.
constexpr double rounding = 1e-14;

/// A block with these eigenvalues, in a basis that is neither orthogonal nor close to singular.
ComplexMatrix block_with(const ComplexVector& eigenvalues, unsigned seed) {
  const Eigen::Index k = eigenvalues.size();
  const ComplexMatrix S = 2.0 * ComplexMatrix::Identity(k, k) + 0.3 * random_complex(k, k, seed);
  return S * eigenvalues.asDiagonal() * S.inverse();
}

ComplexVector functions_of(const ComplexMatrix& Lambda) {
  return block_functions({Lambda}).col(0);
}

std::vector<Complex> list(const ComplexVector& values) {
  return {values.begin(), values.end()};
}

const ComplexVector three{{Complex(-0.1, 3.0), Complex(-0.2, 3.4), Complex(0.05, 2.5)}};

class Blocks : public testing::TestWithParam<Eigen::Index> {
 protected:
  Eigen::Index k = GetParam();
  ComplexVector eigenvalues = (ComplexVector(4) << three, Complex(-0.3, 4.0)).finished().head(k);
  ComplexVector functions = functions_of(block_with(eigenvalues, 3));
};

TEST_P(Blocks, RootsOfTheFunctionsAreTheEigenvalues) {
  EXPECT_EQ(functions.size(), k <= 2 ? k : k * k);
  EXPECT_EQ(block_size(functions.size()), k);
  EXPECT_LT(matched_distance(list(eigenvalues), list(block_roots(functions))), 10.0 * rounding);
}

/// The largest change of every eigenvalue over changes of the functions by their errors in random directions.
Vector seen_errors(const ComplexVector& functions, const ComplexVector& roots, const Vector& errors) {
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  Vector worst = Vector::Zero(roots.size());
  for (int trial = 0; trial < 200; ++trial) {
    ComplexVector moved = functions;
    for (Eigen::Index i = 0; i < moved.size(); ++i) moved[i] += std::polar(errors[i], angle(engine));
    worst = worst.cwiseMax((in_order_of(roots, block_roots(moved)) - roots).cwiseAbs());
  }
  return worst;
}

TEST_P(Blocks, RootErrorBoundsWhatErrorsOfTheFunctionsDo) {
  const Vector errors = Vector::LinSpaced(functions.size(), 1e-9, 3e-9);
  const double bound = root_error(functions, errors, 0.0);
  const double worst = seen_errors(functions, eigenvalues, errors).maxCoeff();
  EXPECT_LE(worst, 1.001 * bound);
  EXPECT_GT(worst, 0.05 * bound) << "a bound that is never approached says nothing";
}

TEST_P(Blocks, RootErrorsBoundEveryEigenvalue) {
  const Vector errors = Vector::LinSpaced(functions.size(), 1e-9, 3e-9);
  const Vector bounds = root_errors(functions, eigenvalues, errors);
  const Vector seen = seen_errors(functions, eigenvalues, errors);
  ASSERT_EQ(bounds.size(), k);
  for (Eigen::Index i = 0; i < k; ++i) {
    EXPECT_LE(seen[i], 1.001 * bounds[i]);
    EXPECT_GT(seen[i], 0.02 * bounds[i]) << "a bound that is never approached says nothing";
  }
}

TEST(RootErrors, OfEqualEigenvaluesThatAreNotDefectiveAreThoseOfSingleOnes) {
  // Four equal oscillators: Lambda = s I. The square root of the error would be 3e-5.
  const Complex s(-0.01, 3.0);
  const ComplexVector roots = ComplexVector::Constant(4, s);
  const ComplexVector functions = functions_of(s * ComplexMatrix::Identity(4, 4));
  const Vector errors = Vector::Constant(functions.size(), 1e-9);
  const Vector bounds = root_errors(functions, roots, errors);
  EXPECT_GE(bounds.minCoeff(), seen_errors(functions, roots, errors).maxCoeff());
  EXPECT_LE(bounds.maxCoeff(), 10.0 * errors.norm());
}

TEST(RootErrors, OfADefectiveBlockAreARootOfTheErrors) {
  for (Eigen::Index k = 3; k <= 5; ++k) {
    // A Jordan block: an entry e in its corner moves all eigenvalues by e^(1/k).
    ComplexMatrix Lambda = Complex(0.0, 3.0) * ComplexMatrix::Identity(k, k);
    Lambda.diagonal(1).setOnes();
    const ComplexVector roots = ComplexVector::Constant(k, Complex(0.0, 3.0));
    Vector errors = Vector::Zero(k * k);
    errors[k - 1] = 1e-9;
    const Vector bounds = root_errors(functions_of(Lambda), roots, errors);
    const double moved = std::pow(1e-9, 1.0 / static_cast<double>(k));
    EXPECT_GE(bounds.minCoeff(), moved);
    EXPECT_LE(bounds.maxCoeff(), 5.0 * moved);
  }
}

TEST(RootErrors, OfTwoFollowTheDiscriminant) {
  const Vector errors{{0.0, 1e-10}};
  // At an exceptional point its square root; away from there error / (2 sqrt(delta)), bounded by twice that.
  const Complex tau(0.0, 3.0);
  EXPECT_DOUBLE_EQ(root_errors(ComplexVector{{tau, 0.0}}, ComplexVector{{tau, tau}}, errors)[0], 1e-5);
  const Vector apart = root_errors(ComplexVector{{tau, 0.01}}, ComplexVector{{tau + 0.1, tau - 0.1}}, errors);
  EXPECT_GE(apart[1], 0.5e-9);
  EXPECT_LE(apart[1], 1.001e-9);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Blocks, testing::Range(Eigen::Index{1}, Eigen::Index{5}));

TEST(BlockFunctions, OfTwoKeepTheirDigitsWhereTheEigenvaluesMeet) {
  // Eigenvalues tau +- 1e-9: delta = 1e-18 is accurate to nine digits, as accurate as Lambda determines it.
  // The formula tau^2 - det has no correct digit.
  ComplexMatrix Lambda(2, 2);
  Lambda << Complex(0.0, 7.0), 1e-9, 1e-9, Complex(0.0, 7.0);
  const ComplexVector functions = functions_of(Lambda);
  EXPECT_LT(std::abs(functions[1] - 1e-18), 1e-9 * 1e-18);
  const Complex rival = functions[0] * functions[0] - Lambda.determinant();
  EXPECT_GT(std::abs(rival - 1e-18), 0.5e-18) << "the rival did not lose";
}

/// Lambda(h) = S [[a + h, 1], [0, a + h]] S^-1: the eigenvalue is double for every h, with one vector.
/// Rounding alone would make two of it that differ by its root.
TEST(BlockFunctions, OfTwoThatAreOneEverywhereHaveADeltaOfZero) {
  const ComplexMatrix S = 2.0 * ComplexMatrix::Identity(2, 2) + 0.3 * random_complex(2, 2, 4);
  const ComplexMatrix one = ComplexMatrix::Identity(2, 2);
  const ComplexMatrix Lambda = S * (ComplexMatrix(2, 2) << -3.7, 1.0, 0.0, -3.7).finished() * S.inverse();
  const ComplexMatrix functions = block_functions({Lambda, S * one * S.inverse(), ComplexMatrix::Zero(2, 2)});
  EXPECT_TRUE(functions.row(1).isZero(0.0));
  EXPECT_NEAR(std::abs(functions(0, 0) + 3.7), 0.0, rounding);
}

/// The same at one h only, where two collide or cross: delta stays what it is.
TEST(BlockFunctions, OfTwoThatAreOneAtAPointKeepTheirDelta) {
  const ComplexMatrix defective = (ComplexMatrix(2, 2) << -3.7, 1.0, 0.0, -3.7).finished();
  const ComplexMatrix corner = (ComplexMatrix(2, 2) << 0.0, 0.0, 1e-6, 0.0).finished();
  EXPECT_NEAR(std::abs(block_functions({defective, corner})(1, 1)), 1e-6, 1e-12);
  const ComplexMatrix apart = (ComplexMatrix(2, 2) << 1e-6, 0.0, 0.0, -1e-6).finished();
  const ComplexMatrix crossing = block_functions({-3.7 * ComplexMatrix::Identity(2, 2), apart, 0.0 * apart});
  EXPECT_NEAR(std::abs(crossing(1, 2)), 1e-12, 1e-18);
}

TEST(BlockFunctions, OfThreeKeepTheDigitsOfEigenvaluesThatCoincide) {
  // Two eigenvalues coincide without being defective. The characteristic polynomial gives them to half the
  // digits only.
  const ComplexVector eigenvalues{{Complex(0.0, 3.0), Complex(0.0, 3.0), Complex(0.0, 3.4)}};
  const ComplexMatrix Lambda = block_with(eigenvalues, 5);
  const ComplexVector roots = in_order_of(eigenvalues, block_roots(functions_of(Lambda)));
  EXPECT_LT((roots - eigenvalues).cwiseAbs().maxCoeff(), 1e-13);
  const Complex a = Lambda.trace();
  const Complex b = 0.5 * (a * a - (Lambda * Lambda).trace());
  const Complex c = Lambda.determinant();
  ComplexMatrix companion(3, 3);
  companion << a, -b, c, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  const ComplexVector rival = in_order_of(eigenvalues, block_roots(companion.reshaped()));
  EXPECT_GT((rival - eigenvalues).cwiseAbs().maxCoeff(), 1e-9) << "the rival did not lose";
}

TEST(BlockFunctions, SeriesFollowTheBlock) {
  // Lambda(h) = L0 + h L1 + h^2 L2: functions of the series are the series of the functions.
  for (Eigen::Index k = 1; k <= 3; ++k) {
    const std::vector<ComplexMatrix> Lambda{block_with(three.head(k), 7), random_complex(k, k, 8),
                                            random_complex(k, k, 9)};
    const ComplexMatrix series = block_functions(Lambda);
    ASSERT_EQ(series.cols(), 3);
    const auto miss = [&](double h) {
      const ComplexVector exact = functions_of(Lambda[0] + h * Lambda[1] + h * h * Lambda[2]);
      return (evaluate_series(series, h) - exact).norm();
    };
    if (k == 2) {
      EXPECT_NEAR(std::log2(miss(0.02) / miss(0.01)), 3.0, 0.1);
    } else {
      EXPECT_LT(miss(0.3), 10.0 * rounding) << "linear in Lambda";
    }
  }
}

TEST(BlockRoots, OfRealFunctionsAreExactlyRealOrConjugate) {
  const ComplexVector oscillating{{Complex(-0.3), Complex(-2.0)}};
  const ComplexVector pair = block_roots(oscillating);
  EXPECT_EQ(pair[0], std::conj(pair[1]));
  EXPECT_EQ(pair[0].real(), -0.3);
  const ComplexVector overdamped = block_roots(ComplexVector{{Complex(-0.3), Complex(0.04)}});
  EXPECT_EQ(overdamped.imag().norm(), 0.0);
  ComplexMatrix real(3, 3);
  real << 0.0, 1.0, 0.0, -2.0, -0.1, 0.5, 0.1, 0.0, -1.0;
  const ComplexVector roots = block_roots(real.reshaped());
  Complex sum = 0.0;
  int upper = 0;
  for (const Complex root : roots) {
    sum += root;
    upper += root.imag() > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(upper, 1);
  EXPECT_EQ(sum.imag(), 0.0) << "conjugates to the last bit";
}

TEST(RootError, NearAMeetingCountsTheLeastGap) {
  const ComplexVector meeting{{Complex(0.0, 3.0), Complex(0.0)}};
  const Vector errors{{1e-9, 1e-9}};
  EXPECT_DOUBLE_EQ(root_error(meeting, errors, 0.2), 1e-9 + 1e-9 / 0.2);
}

/// Eigenvalues that are known series a_i(h), in a basis that turns with h.
class RootsOfBlocks : public testing::TestWithParam<Eigen::Index> {};

TEST_P(RootsOfBlocks, AreTheSeriesTheBlockWasMadeOf) {
  constexpr Eigen::Index count = 6;
  const Eigen::Index k = GetParam();
  const ComplexMatrix exact = random_complex(k, count, 4) + 3.0 * random_complex(k, count, 40);
  std::vector<ComplexMatrix> a;
  for (const auto& of_order : exact.colwise()) a.emplace_back(of_order.asDiagonal());
  const std::vector<ComplexMatrix> Lambda = in_turning_basis(a, count, 5);
  const ComplexMatrix functions = block_functions(Lambda);
  for (Eigen::Index i = 0; i < k; ++i) {
    const ComplexVector series = root_series(functions, exact(i, 0));
    ASSERT_EQ(series.size(), count);
    EXPECT_LT((series - exact.row(i).transpose()).norm(), 1e-11 * exact.row(i).norm()) << "root " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RootsOfBlocks, testing::Values(2, 3, 4));

TEST(RootSeries, OfADoubleRootIsEmpty) {
  ComplexMatrix functions = ComplexMatrix::Zero(2, 4);
  functions(0, 0) = Complex(0.0, 3.0);
  functions(1, 1) = 1.0;
  EXPECT_EQ(root_series(functions, Complex(0.0, 3.0)).size(), 0);
}

TEST(InOrderOf, TakesTheLeastTotalDistanceNotTheNearest) {
  // The nearest of the first would leave the second far.
  const ComplexVector from{{Complex(0.0), Complex(1.0)}};
  const ComplexVector to{{Complex(0.9), Complex(0.6)}};
  const ComplexVector ordered = in_order_of(from, to);
  EXPECT_EQ(ordered[0], Complex(0.6));
  EXPECT_EQ(ordered[1], Complex(0.9));
  const ComplexVector turned{{three[2], three[0], three[1]}};
  EXPECT_EQ(in_order_of(three, turned), three);
  // Two of three are nearest to the same one.
  const ComplexVector contested{{Complex(5.0), Complex(0.9), Complex(1.8)}};
  EXPECT_EQ(in_order_of(ComplexVector{{Complex(0.0), Complex(1.0), Complex(5.1)}}, contested),
            (ComplexVector{{Complex(0.9), Complex(1.8), Complex(5.0)}}));
}

TEST(LeastGap, IsThatOfTheClosestTwo) {
  EXPECT_DOUBLE_EQ(least_gap(ComplexVector{{Complex(0.0), Complex(0.0, 3.0), Complex(0.1, 3.0)}}), 0.1);
  EXPECT_EQ(least_gap(ComplexVector{{Complex(1.0)}}), INFINITY);
}

/// Ten eigenvalues a few thousandths apart: with simple ones each is known by itself, with one Jordan block
/// all but coincide. Both matrices are far from normal.
TEST(RootResolution, IsThatOfADefectiveBlockOnly) {
  constexpr Eigen::Index k = 10;
  Matrix fan = Vector::LinSpaced(k, 2.0, 2.005).asDiagonal();
  fan(0, k - 1) = 1.0;
  const ComplexVector known = fan.cast<Complex>().reshaped();
  EXPECT_EQ(root_resolutions(known, block_roots(known)).maxCoeff(), 0.0);
  Matrix jordan = 2.0 * Matrix::Identity(k, k);
  jordan.diagonal(1).setConstant(0.1);
  jordan(k - 1, 0) = 1e-16;
  const ComplexVector defective = jordan.cast<Complex>().reshaped();
  EXPECT_GT(root_resolutions(defective, block_roots(defective)).minCoeff(), 1e-3);
}

/// A disc that rolls: yaw and its rate are a Jordan block at zero, which rounding splits, and lean is a pair
/// that does not meet it.
TEST(RootResolution, IsThatOfTheTwoThatCoincideOnly) {
  ComplexMatrix Lambda = ComplexMatrix::Zero(4, 4);
  Lambda(0, 1) = 1.0;
  Lambda(1, 0) = 6.4e-23;  // roots +- 8e-12
  Lambda(2, 3) = 1.0;
  Lambda(3, 2) = -0.25;
  const ComplexVector functions = Lambda.reshaped();
  const ComplexVector roots = block_roots(functions);
  const Vector known = root_resolutions(functions, roots);
  for (Eigen::Index i = 0; i < 4; ++i) {
    if (std::abs(roots[i]) < 0.1) {
      EXPECT_GT(known[i], 1.6e-11);
    } else {
      EXPECT_EQ(known[i], 0.0);
    }
  }
}

TEST(SeriesOfVectors, ReciprocalTimesItselfIsOne) {
  const ComplexVector series = random_complex(6, 1, 2);
  const ComplexVector one = multiply_series(series, reciprocal_series(series));
  EXPECT_LT((one - ComplexVector::Unit(6, 0)).norm(), 1e-12);
  // 1 / (1 - h) = 1 + h + h^2 + ...
  EXPECT_LT((reciprocal_series(ComplexVector{{1.0, -1.0, 0.0, 0.0}}) - ComplexVector::Ones(4)).norm(),
            rounding);
}

}  // namespace
}  // namespace eigentrail::test::invariants_test
