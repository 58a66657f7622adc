// The norm in which stiff and soft directions of a pencil count alike, and the norm of a ball that uses it.
#include "continuation/step/ball_norm.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <array>
#include <limits>
#include <stdexcept>

#include "support/families.hpp"

namespace eigentrail::test::energy_norm_test {
namespace {

double largest(const Matrix& A) {
  return Eigen::JacobiSVD<Matrix>(A).singularValues()[0];
}

Matrix value_of(const ReducedPencil& pencil, double shift) {
  return shift * shift * pencil.M[0] + shift * pencil.C[0] + pencil.K[0];
}

/// R of a pencil's norm at a shift. Fails if there is none.
Matrix root_of(const ReducedPencil& pencil, double shift) {
  const auto norm = EnergyNorm::of(PencilAtPoint(pencil), shift);
  if (!norm) throw std::runtime_error("there is no energy norm");
  return norm->times(ComplexMatrix::Identity(pencil.size(), pencil.size())).real();
}

/// |P^-1 dP| in the energy norm of a pencil at a shift.
double change(const ReducedPencil& pencil, const Matrix& dP, double of_P, double shift) {
  const Matrix R = root_of(pencil, shift);
  return largest(R * value_of(pencil, of_P).lu().solve(dP) * R.inverse());
}

/// A chain of masses on springs, fixed at one end. Every other spring is `ratio` times stiffer.
struct Chain {
  Chain(Eigen::Index n, double ratio) {
    const auto springs = [n](const auto& stiffness) {
      Matrix K = Matrix::Zero(n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        K(i, i) += stiffness(i);
        if (i == 0) continue;
        K(i - 1, i - 1) += stiffness(i);
        K(i, i - 1) -= stiffness(i);
        K(i - 1, i) -= stiffness(i);
      }
      return K;
    };
    const auto stiffness = [ratio](Eigen::Index i) { return i % 2 == 0 ? 1.0 : ratio; };
    const Matrix K = springs(stiffness);
    pencil = {{Matrix::Identity(n, n)}, {0.02 * K}, {K}};
    softening = springs([&](Eigen::Index i) { return -0.1 * static_cast<double>(i % 3) * stiffness(i); });
  }
  ReducedPencil pencil;
  Matrix softening;  ///< of the springs by nothing, a tenth and a fifth in turn
};

/// Gyroscopic and circulatory forces do no work that is stored: x^T P x is the energy all the same.
TEST(EnergyNorm, IsTheEnergyWhereThatIsPositive) {
  Chain chain(6, 50.0);
  std::mt19937_64 engine(4);
  const Matrix any = random_matrix(6, 6, engine);
  chain.pencil.C[0] += any - any.transpose();
  chain.pencil.K[0] += 5.0 * (any - any.transpose());
  const Matrix R = root_of(chain.pencil, 0.7);
  const Vector x = random_matrix(6, 1, engine);
  const double energy = x.dot(value_of(chain.pencil, 0.7) * x);
  EXPECT_NEAR((R * x).squaredNorm(), energy, 1e-12 * energy);
}

/// Otherwise (R^T R)^2 = P^T P.
TEST(EnergyNorm, IsThatOfThePolarDecompositionWhereItIsNot) {
  ReducedPencil family = at(random_family(7, 3), 0.2);
  family.K[0].row(2) *= -3.0;
  const Matrix P = value_of(family, 1.3);
  ASSERT_LT(Vector((P + P.transpose()).eigenvalues().real()).minCoeff(), 0.0);
  const Matrix R = root_of(family, 1.3);
  const Matrix H = R.transpose() * R;
  EXPECT_LT((H * H - P.transpose() * P).norm(), 1e-12 * P.squaredNorm());
}

/// By bands and by full matrices, of the energy and of the polar decomposition.
TEST(EnergyNorm, HasInversesAndTransposes) {
  ReducedPencil indefinite = at(random_family(7, 3), 0.2);
  indefinite.K[0].row(2) *= -3.0;
  for (const ReducedPencil& pencil : {Chain(70, 50.0).pencil, Chain(6, 50.0).pencil, indefinite}) {
    const auto norm = EnergyNorm::of(PencilAtPoint(pencil), 1.3);
    ASSERT_TRUE(norm);
    const ComplexMatrix I = ComplexMatrix::Identity(pencil.size(), pencil.size());
    const ComplexMatrix R = norm->times(I);
    EXPECT_LT((norm->inverse_times(R) - I).norm(), 1e-11);
    EXPECT_LT((norm->transposed_times(I) - R.transpose()).norm(), 1e-13 * R.norm());
    EXPECT_LT((norm->inverse_transposed_times(R.transpose()) - I).norm(), 1e-11);
  }
}

/// A change of coordinates of a symmetric pencil changes the plain norm by the square of its condition, and
/// this norm not at all.
TEST(EnergyNorm, DoesNotDependOnTheCoordinates) {
  std::mt19937_64 engine(5);
  const Chain chain(8, 3.0);
  Matrix T = random_matrix(8, 8, engine);
  T.row(0) *= 1e-2;
  T.row(5) *= 1e2;
  const auto turned = [&](const Matrix& A) { return Matrix(T.transpose() * A * T); };
  const ReducedPencil other{
      {turned(chain.pencil.M[0])}, {turned(chain.pencil.C[0])}, {turned(chain.pencil.K[0])}};
  const double here = change(chain.pencil, chain.softening, 0.6, 0.6);
  EXPECT_NEAR(change(other, turned(chain.softening), 0.6, 0.6), here, 1e-6 * here);
  const double plain = largest(value_of(chain.pencil, 0.6).lu().solve(chain.softening));
  const double turned_plain = largest(value_of(other, 0.6).lu().solve(turned(chain.softening)));
  EXPECT_GT(turned_plain, 1e3 * plain);
}

/// A weak coupling of a stiff and a soft freedom is a small change. In the plain norm it is as large as the
/// ratio of their stiffnesses.
TEST(EnergyNorm, MakesTheCouplingOfStiffAndSoftSmall) {
  const double stiff = 1e8;
  const Matrix I = Matrix::Identity(2, 2);
  const ReducedPencil pencil{{I}, {Matrix::Zero(2, 2)}, {Matrix{{1.0, 0.0}, {0.0, stiff}}}};
  const double coupling = 0.1 * std::sqrt(stiff);
  const Matrix dP{{0.0, coupling}, {coupling, 0.0}};
  EXPECT_GT(largest(value_of(pencil, 1.0).lu().solve(dP)), 100.0);
  EXPECT_LT(change(pencil, dP, 1.0, 1.0), 0.2);
}

/// The shift is a matter of strength: over two decades the norm of a change is about the same, whatever the
/// stiffnesses.
TEST(EnergyNorm, DependsLittleOnTheShift) {
  const Chain chain(10, 1e6);
  const double best = change(chain.pencil, chain.softening, 0.5, 0.5);
  EXPECT_LT(best, 0.3);
  for (const double shift : {0.05, 0.15, 1.5, 5.0})
    EXPECT_LT(change(chain.pencil, chain.softening, 0.5, shift), 5.0 * best) << shift;
}

TEST(EnergyNorm, IsNoneOfASingularPencilOrOfNoNumbers) {
  const Matrix I = Matrix::Identity(2, 2);
  const Matrix zero = Matrix::Zero(2, 2);
  const ReducedPencil singular{{zero}, {zero}, {Matrix{{1.0, 1.0}, {1.0, 1.0}}}};
  EXPECT_FALSE(EnergyNorm::of(PencilAtPoint(singular), 1.0));
  const ReducedPencil none{{I}, {zero}, {std::numeric_limits<double>::quiet_NaN() * I}};
  EXPECT_FALSE(EnergyNorm::of(PencilAtPoint(none), 1.0));
}

/// The maps of a ball's norm for a block of k modes, all parts in use.
class NormOfABall : public testing::TestWithParam<int> {
 protected:
  NormOfABall() {
    norm.set_energy(EnergyNorm::of(PencilAtPoint(family), 1.1), Z);
    ComplexMatrix Q =
        random_complex(size, 2, engine).householderQr().householderQ() * ComplexMatrix::Identity(size, 2);
    const ComplexMatrix T = random_complex(size, size, engine) +
                            40.0 * random_complex(size, 1, engine) * random_complex(1, size, engine);
    const ComplexMatrix adjoint = T.adjoint() * Q;
    const ComplexMatrix TQ = T * Q;
    norm.set_adapted(AdaptedNorm::balancing(std::move(Q), TQ, adjoint));
  }

  /// The matrix of one of the norm's maps.
  ComplexMatrix matrix(void (BallNorm::*map)(ComplexMatrix&) const) const {
    ComplexMatrix columns = ComplexMatrix::Identity(size, size);
    (norm.*map)(columns);
    return columns;
  }

  static constexpr Eigen::Index n = 6;
  Eigen::Index k = GetParam();
  Eigen::Index size = n * k + k * k;
  std::mt19937_64 engine{8};
  ReducedPencil family = at(random_family(n, 3), 0.0);
  ComplexMatrix Z = random_complex(n, k, engine);
  BallNorm norm{n, k};
};

TEST_P(NormOfABall, HasInversesAndAdjoints) {
  const ComplexMatrix S = matrix(&BallNorm::apply);
  const ComplexMatrix inverse = matrix(&BallNorm::apply_inverse);
  EXPECT_GT((S - ComplexMatrix::Identity(size, size)).norm(), 0.1);
  EXPECT_LT((S * inverse - ComplexMatrix::Identity(size, size)).norm(), 1e-12 * S.norm() * inverse.norm());
  EXPECT_LT((matrix(&BallNorm::apply_adjoint) - S.adjoint()).norm(), 1e-13 * S.norm());
  EXPECT_LT((matrix(&BallNorm::apply_inverse_adjoint) - inverse.adjoint()).norm(), 1e-13 * inverse.norm());
}

TEST_P(NormOfABall, BoundsTheEigenvaluePart) {
  const ComplexMatrix rows = matrix(&BallNorm::apply).bottomRows(k * k);
  const double expected = Eigen::JacobiSVD<ComplexMatrix>(rows).singularValues()[0];
  EXPECT_NEAR(norm.largest_eigenvalue_part(), expected, 1e-12 * expected);
  EXPECT_EQ(BallNorm(n, k).largest_eigenvalue_part(), 1.0);
}

TEST_P(NormOfABall, OfEnergyLeavesTheModesAsLongAsTheyAre) {
  BallNorm energy(n, k);
  energy.set_energy(EnergyNorm::of(PencilAtPoint(family), 1.1), Z);
  ComplexVector x = ComplexVector::Zero(size);
  x.head(n * k) = Z.reshaped();
  energy.apply_inverse(x);
  EXPECT_NEAR(x.norm(), Z.norm(), 1e-13 * Z.norm());
}

INSTANTIATE_TEST_SUITE_P(Blocks, NormOfABall, testing::Values(1, 2, 3));

}  // namespace
}  // namespace eigentrail::test::energy_norm_test
