// The spectrum of the differential-algebraic forms (27) and (30) of the seed paper against the projected
// pencil (25), and the equivalence (46) of the two forms of the geometric stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::dae_form_test {
namespace {

constexpr double spectrum_tolerance = 1e-10;

struct Case {
  std::string name;
  std::string scene;
  double at;
};

class DaeForm : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    setting = scene_setting(GetParam().scene);
    point = point_from_guess(setting.problem(), GetParam().at, counts);
    const Linearization& lin = point.equilibrium.linearization;
    n = lin.M[0].rows();
    m = lin.A[0].rows();
    // The constraints are scaled to the stiffness, which changes neither form's finite spectrum.
    A = lin.A[0].dense() * (lin.K[0].norm() / lin.A[0].norm());
    M = lin.M[0].dense();
    C = lin.C[0].dense();
    K = lin.K[0].dense();
    for (const InvariantPair& pair : point.pairs) {
      const Complex s = pair.eigenvalue();
      projected.push_back(s);
      if (s.imag() != 0.0) projected.push_back(std::conj(s));
    }
  }

  /// Finite part of a DAE spectrum: 2 (n - m) eigenvalues of least magnitude. The infinite ones are
  /// defective, so rounding brings them to about 1/eps^(1/3) times the finite ones; a gap must separate the
  /// two groups.
  std::vector<Complex> finite_part(std::vector<Complex> all, std::size_t n_expected_infinite,
                                   int n_infinite) const {
    std::sort(all.begin(), all.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    const auto n_finite = static_cast<std::size_t>(2 * (n - m));
    EXPECT_EQ(all.size() + static_cast<std::size_t>(n_infinite), n_finite + n_expected_infinite);
    for (std::size_t i = n_finite; i < all.size(); ++i) {
      EXPECT_GT(std::abs(all[i]), 100.0 * std::abs(all[n_finite - 1]))
          << "no gap before the infinite eigenvalues";
    }
    all.resize(n_finite);
    return all;
  }

  Setting setting;
  RunCounts counts;
  PathPoint point;
  Eigen::Index n = 0, m = 0;
  Matrix M, C, K, A;
  std::vector<Complex> projected;
};

TEST_P(DaeForm, FirstOrderForm27HasTheProjectedSpectrumAnd3mInfiniteEigenvalues) {
  const Eigen::Index size = 2 * n + m;
  Matrix E = Matrix::Zero(size, size);
  Matrix minus = Matrix::Zero(size, size);
  E.topLeftCorner(n, n) = M;
  E.block(n, n, n, n).setIdentity();
  minus.topLeftCorner(n, n) = C;
  minus.block(0, n, n, n) = K;
  minus.topRightCorner(n, m) = A.transpose();
  minus.block(n, 0, n, n) = -Matrix::Identity(n, n);
  minus.block(2 * n, n, m, n) = A;
  int n_infinite = 0;
  const auto all = qz_eigenvalues(-minus, E, 1e-14, &n_infinite);
  const auto finite = finite_part(all, static_cast<std::size_t>(3 * m), n_infinite);
  EXPECT_LT(matched_distance(projected, finite), spectrum_tolerance);
}

TEST_P(DaeForm, SecondOrderForm30HasTheProjectedSpectrum) {
  const Eigen::Index size = n + m;
  Matrix mass = Matrix::Zero(size, size);
  Matrix damping = Matrix::Zero(size, size);
  Matrix stiffness = Matrix::Zero(size, size);
  mass.topLeftCorner(n, n) = M;
  damping.topLeftCorner(n, n) = C;
  stiffness.topLeftCorner(n, n) = K;
  stiffness.topRightCorner(n, m) = A.transpose();
  stiffness.bottomLeftCorner(m, n) = A;
  Matrix a = Matrix::Zero(2 * size, 2 * size);
  Matrix b = Matrix::Identity(2 * size, 2 * size);
  a.topRightCorner(size, size).setIdentity();
  a.bottomLeftCorner(size, size) = -stiffness;
  a.bottomRightCorner(size, size) = -damping;
  b.bottomRightCorner(size, size) = mass;
  int n_infinite = 0;
  const auto all = qz_eigenvalues(a, b, 1e-14, &n_infinite);
  const auto finite = finite_part(all, static_cast<std::size_t>(4 * m), n_infinite);
  EXPECT_LT(matched_distance(projected, finite), spectrum_tolerance);
}

TEST_P(DaeForm, GeometricStiffnessEquivalence46Holds) {
  // T^T (A^T lambda0)_/x T = -(T_/x^T f) T with T_/xk = -A+ A_/xk T, where f = A^T lambda0 at the
  // equilibrium.
  const PathProblem problem = setting.problem();
  const Vector parameters = parameters_at(problem, GetParam().at);
  const Vector& x = point.equilibrium.x;
  const Vector& lambda = point.equilibrium.lambda;
  const ConstraintFactorization& constraints = point.equilibrium.kkt.constraints();
  const Matrix& T = constraints.null_basis();
  Linearization with, without;
  ASSERT_FALSE(setting.model->linearize({parameters, x, lambda}, 0, with, counts.evaluations));
  ASSERT_FALSE(setting.model->linearize({parameters, x, Vector::Zero(m)}, 0, without, counts.evaluations));
  const Matrix left = T.transpose() * (with.K[0].dense() - without.K[0].dense()) * T;

  const Vector f = with.A[0].transposed_times(lambda);
  Matrix gradient(T.cols(), n);  // column k: T_/xk^T f
  for (Eigen::Index k = 0; k < n; ++k) {
    VectorSeries moving = VectorSeries::Zero(n, 2);
    moving.col(0) = x;
    moving(k, 1) = 1.0;
    Linearization along;
    ASSERT_FALSE(setting.model->linearize({parameters, moving, lambda}, 1, along, counts.evaluations));
    const Matrix A_k = along.A.size() > 1 ? along.A[1].dense() : Matrix(Matrix::Zero(m, n));
    gradient.col(k) = (-constraints.pseudo_inverse_times(A_k * T)).transpose() * f;
  }
  EXPECT_LT((left + gradient * T).norm(), 1e-12 * with.K[0].norm());
}

INSTANTIATE_TEST_SUITE_P(Systems, DaeForm,
                         testing::Values(Case{"Pendulum", "pendulum", 1.5},
                                         Case{"SpringPendulum", "spring_pendulum", 26.16},
                                         Case{"RotatingMassFast", "rotating_mass", 100.0},
                                         Case{"RotatingMass", "rotating_mass", 40.0}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test::dae_form_test
