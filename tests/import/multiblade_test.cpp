// Multiblade coordinates: rotors of equal blades have constant matrices in them.
#include "import/multiblade.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/multiblade/harmonics.hpp"

namespace eigentrail::test::multiblade_test {
namespace {

constexpr double rotor_speed = 1.7;
constexpr double stiffness = 5.0, damping = 0.3, coupling = 0.8;

/// Equal blades on a hub that can move in x and y: q_k'' + d q_k' + k q_k + c (x'' part left out) = forces of
/// the hub, in the rotating frame. Blade k feels coupling * (x cos psi_k + y sin psi_k), and the hub the sum
/// of the blades with the same factors. States: q_1 ... q_N, x, y, then their rates.
struct Rotor {
  explicit Rotor(std::size_t n_blades) : n(n_blades) {}

  Matrix A(double azimuth) const {
    const auto N = static_cast<Eigen::Index>(n);
    const Eigen::Index half = N + 2;
    Matrix K = Matrix::Zero(half, half), C = damping * Matrix::Identity(half, half);
    for (Eigen::Index k = 0; k < N; ++k) {
      const double psi = azimuth + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(N);
      K(k, k) = stiffness;
      // Neighbours are coupled, too.
      K(k, (k + 1) % N) += 0.2;
      K(k, (k + N - 1) % N) += 0.2;
      K(k, N) = K(N, k) = coupling * std::cos(psi);
      K(k, N + 1) = K(N + 1, k) = coupling * std::sin(psi);
    }
    K(N, N) = 2.0;
    K(N + 1, N + 1) = 3.0;
    Matrix result = Matrix::Zero(2 * half, 2 * half);
    result.topRightCorner(half, half).setIdentity();
    result.bottomLeftCorner(half, half) = -K;
    result.bottomRightCorner(half, half) = -C;
    return result;
  }

  BladeStates blades(bool with_rates) const {
    BladeStates tuple;
    for (std::size_t k = 0; k < n; ++k) {
      tuple.states.push_back(static_cast<Eigen::Index>(k));
      if (with_rates) tuple.rates.push_back(static_cast<Eigen::Index>(k + n + 2));
    }
    return tuple;
  }

  Matrix transformed(double azimuth) const {
    const Eigen::Index size = 2 * (static_cast<Eigen::Index>(n) + 2);
    return in_multiblade_coordinates(A(azimuth), multiblade(size, {blades(true)}, azimuth, rotor_speed),
                                     rotor_speed);
  }

  std::size_t n;
};

class Multiblade : public testing::TestWithParam<std::size_t> {};

TEST_P(Multiblade, EqualBladesGiveConstantMatrices) {
  const Rotor rotor(GetParam());
  const Matrix reference = rotor.transformed(0.0);
  for (const double azimuth : {0.1, 1.0, 2.5, 4.0, 6.1})
    EXPECT_LT((rotor.transformed(azimuth) - reference).norm(), 1e-13 * reference.norm()) << azimuth;
}

/// The rival: without the transformation the matrices change with the azimuth.
TEST_P(Multiblade, WithoutThemTheMatricesArePeriodic) {
  const Rotor rotor(GetParam());
  EXPECT_GT((rotor.A(1.0) - rotor.A(0.0)).norm(), 0.1 * rotor.A(0.0).norm());
}

/// Blades 2 ... N of the next turn: psi and psi + 2 pi / N are the same rotor with blades renumbered.
TEST_P(Multiblade, StatesTransformBackAndForth) {
  const Rotor rotor(GetParam());
  const Eigen::Index size = 2 * (static_cast<Eigen::Index>(rotor.n) + 2);
  const MultibladeTransformation t = multiblade(size, {rotor.blades(true)}, 0.7, rotor_speed);
  EXPECT_LT(t.T.inverse().norm(), 1e3);
  // The derivative by the azimuth, against a difference of fourth order.
  const auto T = [&](double psi) { return multiblade(size, {rotor.blades(true)}, psi, rotor_speed).T; };
  const double h = 1e-3;
  const Matrix difference =
      (8.0 * (T(0.7 + h) - T(0.7 - h)) - (T(0.7 + 2 * h) - T(0.7 - 2 * h))) / (12.0 * h);
  EXPECT_LT((difference - t.derivative).norm(), 1e-9 * t.derivative.norm());
}

/// Rates: the state (q, q') of blades that move as a_1 cos(psi_k) with constant a_1 has the rate
/// -Omega a_1 sin(psi_k), which in multiblade coordinates is a rate of zero.
TEST_P(Multiblade, RatesAreThoseOfTheCoordinates) {
  const Rotor rotor(GetParam());
  const auto N = static_cast<Eigen::Index>(rotor.n);
  const Eigen::Index size = 2 * (N + 2);
  const double azimuth = 0.4;
  const MultibladeTransformation t = multiblade(size, {rotor.blades(true)}, azimuth, rotor_speed);
  Vector coordinates = Vector::Zero(size);
  coordinates(1) = 1.0;  // cosine
  const Vector x = t.T * coordinates;
  for (Eigen::Index k = 0; k < N; ++k) {
    const double psi = azimuth + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(N);
    EXPECT_NEAR(x(k), std::cos(psi), 1e-15);
    EXPECT_NEAR(x(N + 2 + k), -rotor_speed * std::sin(psi), 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(Blades, Multiblade, testing::Values(3, 4, 5, 6),
                         [](const auto& blades) { return std::to_string(blades.param) + "_blades"; });

/// States of first order, such as those of an inflow, have no rates: x_k' = -x_k / tau of each blade becomes
/// a_0' = -a_0 / tau, and the cosine and sine are coupled by the speed: a' = -a / tau - Omega b.
TEST(MultibladeFirstOrder, SpeedCouplesCosineAndSine) {
  const Matrix A = -2.0 * Matrix::Identity(3, 3);
  const MultibladeTransformation t = multiblade(3, {{{0, 1, 2}}}, 0.9, rotor_speed);
  const Matrix expected{{-2.0, 0.0, 0.0}, {0.0, -2.0, -rotor_speed}, {0.0, rotor_speed, -2.0}};
  EXPECT_LT((in_multiblade_coordinates(A, t, rotor_speed) - expected).norm(), 1e-14);
}

TEST(MultibladeNames, OfAllCoordinates) {
  EXPECT_EQ(multiblade_names(3), (std::vector<std::string>{"collective", "cosine", "sine"}));
  EXPECT_EQ(multiblade_names(4), (std::vector<std::string>{"collective", "cosine", "sine", "differential"}));
  EXPECT_EQ(multiblade_names(5),
            (std::vector<std::string>{"collective", "cosine", "sine", "cosine 2", "sine 2"}));
}

}  // namespace
}  // namespace eigentrail::test::multiblade_test
