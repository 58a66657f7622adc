// Which samples to compute next: few that are placed where the stated error is largest reach what many
// equidistant ones with a cubic spline reach.
#include "eigentrail/accuracy/suggest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eigentrail/core/errors.hpp"
#include "support/families.hpp"
#include "support/sampled.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::suggest_test {
namespace {

constexpr Eigen::Index size = 4;
constexpr double wanted = 1e-6;

/// Families on 0 <= p <= 1.
enum class Family { pole, two_poles, resonance, smooth };

MatrixFunction family(Family kind) {
  std::mt19937_64 engine(7);
  const Matrix A0 =
      random_matrix(size, size, engine) - Matrix(Vector::LinSpaced(size, 2.0, 12.0).asDiagonal());
  const Matrix A1 = random_matrix(size, size, engine), A2 = random_matrix(size, size, engine);
  switch (kind) {
    case Family::pole:
      return [=](double p) { return Matrix(A0 + 0.02 / (p + 0.1) * A1 + p * A2); };
    case Family::two_poles:
      return [=](double p) { return Matrix(A0 + 0.02 / (p + 0.1) * A1 + 0.02 / (1.1 - p) * A2); };
    case Family::resonance:
      return [=](double p) { return Matrix(A0 + 0.1 / (0.04 + (p - 0.3) * (p - 0.3)) * A1 + p * A2); };
    case Family::smooth:
      return [=](double p) { return Matrix(A0 + std::sin(6.0 * p) * A1 + std::exp(2.0 * p) * A2); };
  }
  return {};
}

/// The largest distance of an eigenvalue of one matrix from its neighbour of the other, relative.
double difference(const Matrix& found, const Matrix& exact) {
  const ComplexVector s = Eigen::EigenSolver<Matrix>(exact).eigenvalues();
  const ComplexVector t = Eigen::EigenSolver<Matrix>(found).eigenvalues();
  double worst = 0.0;
  for (const Complex one : s) {
    double least = INFINITY;
    for (const Complex other : t) least = std::min(least, std::abs(one - other));
    worst = std::max(worst, least / std::abs(one));
  }
  return worst;
}

constexpr int places = 400;
double place(int i) {
  return (i + 0.5) / places;
}

/// Error of the eigenvalues between samples at `values`, as eigentrail interpolates.
double interpolated_error(const MatrixFunction& truth, const std::vector<double>& values) {
  const SampledScene scene(sampled(truth, values));
  const Setting setting = scene.setting();
  double worst = 0.0;
  for (int i = 0; i < places; ++i) {
    RunCounts counts;
    const PathPoint point = point_from_guess(setting.problem(), place(i), counts);
    worst = std::max(worst, difference(-point.pencil.K[0], truth(place(i))));
  }
  return worst;
}

/// The cubic spline through equidistant samples whose third derivative is continuous at the second and the
/// last but one ("not a knot"). Returns, for x, the factors of the samples.
class Spline {
 public:
  explicit Spline(int n) : n_(n), second_derivatives_(n, n) {
    // Second derivatives m of the unit data: m_(i-1) + 4 m_i + m_(i+1) = 6 (y_(i-1) - 2 y_i + y_(i+1)) / h^2.
    Matrix left = Matrix::Zero(n, n), right = Matrix::Zero(n, n);
    for (int i = 1; i + 1 < n; ++i) {
      left.row(i).segment(i - 1, 3) << 1.0, 4.0, 1.0;
      right.row(i).segment(i - 1, 3) << 6.0, -12.0, 6.0;
    }
    left.row(0).head(3) << 1.0, -2.0, 1.0;
    left.row(n - 1).tail(3) << 1.0, -2.0, 1.0;
    second_derivatives_ = left.partialPivLu().solve(right);
  }

  Vector factors(double x) const {
    const double scaled = x * (n_ - 1);
    const int i = std::min(static_cast<int>(scaled), n_ - 2);
    const double b = scaled - i, a = 1.0 - b;
    Vector result = (a * a * a - a) / 6.0 * second_derivatives_.row(i) +
                    (b * b * b - b) / 6.0 * second_derivatives_.row(i + 1);
    result[i] += a;
    result[i + 1] += b;
    return result;
  }

 private:
  int n_;
  Matrix second_derivatives_;
};

double spline_error(const MatrixFunction& truth, int n) {
  const Spline spline(n);
  std::vector<Matrix> samples;
  for (int i = 0; i < n; ++i) samples.push_back(truth(static_cast<double>(i) / (n - 1)));
  double worst = 0.0;
  for (int i = 0; i < places; ++i) {
    const Vector factors = spline.factors(place(i));
    Matrix A = Matrix::Zero(size, size);
    for (int k = 0; k < n; ++k) A += factors[k] * samples[static_cast<std::size_t>(k)];
    worst = std::max(worst, difference(A, truth(place(i))));
  }
  return worst;
}

/// Adds the first suggestion until the true error is small enough; the number of samples.
std::size_t suggested_samples(const MatrixFunction& truth) {
  std::vector<double> values{0.0, 0.25, 0.5, 0.75, 1.0};
  while (values.size() < 40) {
    if (interpolated_error(truth, values) < wanted) break;
    values.push_back(suggest_samples(SampledScene(sampled(truth, values)).setting()).front().p);
    std::sort(values.begin(), values.end());
  }
  return values.size();
}

/// A family and a number of equidistant samples with which the spline is not accurate enough.
class Suggest : public testing::TestWithParam<std::pair<Family, int>> {};

TEST_P(Suggest, TwelveSamplesReachWhatManyEquidistantOnesWithASplineMiss) {
  const auto [kind, n_spline] = GetParam();
  EXPECT_LE(suggested_samples(family(kind)), 12u);
  EXPECT_GT(spline_error(family(kind), n_spline), wanted);
}

INSTANTIATE_TEST_SUITE_P(Families, Suggest,
                         testing::Values(std::pair{Family::pole, 59}, std::pair{Family::two_poles, 59},
                                         std::pair{Family::resonance, 59}, std::pair{Family::smooth, 50}));

TEST(SuggestedSamples, AreOrderedByErrorAndHaveFewDecimals) {
  const MatrixFunction truth = family(Family::pole);
  const std::vector<Suggestion> all =
      suggest_samples(SampledScene(sampled(truth, {0.0, 0.3, 0.6, 0.8, 1.0})).setting());
  ASSERT_EQ(all.size(), 4u);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GE(all[i - 1].error, all[i].error);
  EXPECT_LT(all.front().p, 0.3);  // the pole is at -0.1
  for (const Suggestion& one : all) EXPECT_EQ(one.p, std::round(one.p * 1000.0) / 1000.0);
}

TEST(SuggestedSamples, NeedSamplesAndMoreThanOne) {
  EXPECT_THROW(suggest_samples(scene_setting("rotating_mass")), InputError);
  const SampledScene one(sampled(family(Family::pole), {0.5}), "", "from = 0.5\n");
  EXPECT_THROW(suggest_samples(one.setting(Purpose::operating_point)), InputError);
}

}  // namespace
}  // namespace eigentrail::test::suggest_test
