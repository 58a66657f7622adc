// Functions of eigenvalues whose zeros are events: values against series, series against differences.
#include "continuation/events/criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::criterion_test {
namespace {

const std::vector<Criterion> all{{EventKind::flutter, 0.0},
                                 {EventKind::damping_ratio, 0.3},
                                 {EventKind::resonance, 2.0},
                                 {EventKind::extremum, 0.0}};

TEST(Criterion, SeriesIsThatOfTheValue) {
  // mu(h) = exp((-0.2 + 1.3j) + (0.4 - 0.7j) h), excitation 0.6 + h.
  const Complex rate(0.4, -0.7);
  const auto mu_at = [&](double h) { return std::exp(Complex(-0.2, 1.3) + rate * h); };
  ComplexVector mu(5);
  mu[0] = mu_at(0.0);
  for (Eigen::Index k = 1; k < 5; ++k) mu[k] = mu[k - 1] * rate / static_cast<double>(k);
  const Vector excitation{{0.6, 1.0, 0.0, 0.0, 0.0}};
  for (const Chart chart : {Chart::finite, Chart::reciprocal}) {
    for (const Criterion& criterion : all) {
      const Vector series = criterion_series(criterion, mu, chart, excitation);
      // The remainder falls with the fifth power.
      const auto miss = [&](double h) {
        double sum = 0.0;
        for (Eigen::Index k = 4; k >= 0; --k) sum = sum * h + series[k];
        return std::abs(sum - criterion_value(criterion, mu_at(h), chart, 0.6 + h));
      };
      EXPECT_LT(miss(0.05), 1e-5);
      if (miss(0.05) > 1e-14) {
        EXPECT_NEAR(miss(0.1) / miss(0.05), 32.0, 10.0);
      }
    }
  }
}

TEST(Criterion, ZerosOfBothChartsAreTheSame) {
  // Damping ratio 0.3, and Im s = 2 * 0.6.
  const Complex damped = 1.4 * Complex(-0.3, std::sqrt(1.0 - 0.09));
  const Complex resonant(-0.1, 1.2);
  EXPECT_NEAR(criterion_value(all[1], damped, Chart::finite, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(criterion_value(all[1], 1.0 / std::conj(damped), Chart::reciprocal, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(criterion_value(all[2], resonant, Chart::finite, 0.6), 0.0, 1e-15);
  EXPECT_NEAR(criterion_value(all[2], 1.0 / resonant, Chart::reciprocal, 0.6), 0.0, 1e-15);
}

}  // namespace
}  // namespace eigentrail::test::criterion_test
