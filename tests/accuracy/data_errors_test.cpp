// Errors of eigenvalues from sampled data: the true error of families in closed form lies within the stated
// one, and that is not much larger.
#include "eigentrail/accuracy/data_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "eigentrail/stability/undecided_ranges.hpp"
#include "support/families.hpp"
#include "support/sampled.hpp"
#include "support/spectra.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test::data_errors_test {
namespace {

constexpr Eigen::Index size = 6;

/// `root` behaves like the square root of the distance from an end of the range; `kink` changes its slope
/// between two samples, which nothing declares.
enum class Kind { smooth, pole, branch, noise, root, kink };

/// A random family of that kind on 0 <= p <= 1.
MatrixFunction random_function(Kind kind, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Matrix> A;
  for (int i = 0; i < 4; ++i) A.push_back(random_matrix(size, size, engine));
  for (Eigen::Index i = 0; i < size; ++i) A[0](i, i) -= 2.0 * static_cast<double>(i + 1);
  const double distance = 0.05 + 0.25 * uniform(engine);
  const double place = uniform(engine) < 0.5 ? -distance : 1.0 + distance;
  if (kind == Kind::pole)
    return [A, place](double p) { return Matrix(A[0] + 0.1 / (p - place) * A[1] + 0.3 * p * A[2]); };
  // No rational function: a branch point beside the range, as that of 1 / sqrt(1 - Mach^2).
  if (kind == Kind::branch) {
    return [A, place](double p) {
      return Matrix(A[0] + 0.3 / std::sqrt(std::abs(p - place)) * A[1] + 0.3 * p * A[2]);
    };
  }
  if (kind == Kind::root)
    return [A](double p) { return Matrix(A[0] + std::sqrt(std::max(p, 0.0)) * A[1] + 0.3 * p * A[2]); };
  if (kind == Kind::kink) {
    const double corner = 0.2 + 0.6 * uniform(engine);
    return [A, corner](double p) { return Matrix(A[0] + std::abs(p - corner) * A[1] + 0.3 * p * A[2]); };
  }
  const double rate = 4.0 + 4.0 * uniform(engine), phase = 6.0 * uniform(engine);
  return [A, rate, phase](double p) {
    return Matrix(A[0] + 0.5 * std::sin(rate * p + phase) * A[1] + 0.5 * std::exp(p) * A[2] +
                  0.3 * p * p * A[3]);
  };
}

std::vector<Complex> spectrum_of(const Matrix& A) {
  const ComplexVector s = Eigen::EigenSolver<Matrix>(A).eigenvalues();
  return {s.begin(), s.end()};
}

/// What a study found: ratios of the true error to the stated one.
struct Ratios {
  double worst = 0.0;   ///< the largest one
  double within = 0.0;  ///< share of the places at which it is at most 1
  double median = 0.0;  ///< median of the inverse
};

/// Errors of the interpolated eigenvalues at random places, beside a tolerance as a trace would have.
Ratios study(Kind kind, int samples, int families, int places) {
  std::vector<double> inverse;
  Ratios ratios;
  for (int family = 0; family < families; ++family) {
    std::mt19937_64 engine(static_cast<unsigned>(100 * samples + family));
    const MatrixFunction truth = random_function(kind, engine);
    SampledData data = sampled(truth, sample_values(samples, static_cast<unsigned>(family)));
    std::normal_distribution<double> normal;
    if (kind == Kind::noise) {
      for (Matrix& A : data.A) A = A.unaryExpr([&](double x) { return x * (1.0 + 1e-4 * normal(engine)); });
    }
    const SampledScene scene(data);
    const Setting setting = scene.setting();
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < places; ++i) {
      const double p = uniform(engine);
      RunCounts counts;
      const PathPoint point = point_from_guess(setting.problem(), p, counts);
      const std::vector<Complex> interpolated = spectrum_of(-point.pencil.K[0]);
      const std::vector<Complex> exact = spectrum_of(truth(p));
      const ComplexVector s = Eigen::Map<const ComplexVector>(interpolated.data(), size);
      const Matrix stated = *data_errors_at(*setting.model, setting.options, p, s);
      for (Eigen::Index k = 0; k < size; ++k) {
        double error = INFINITY;
        for (const Complex other : exact) error = std::min(error, std::abs(other - s[k]));
        const double tolerance = 1e-13 * std::abs(s[k]);
        const double bound = stated(k, 0) + stated(k, 1) + tolerance;
        ratios.worst = std::max(ratios.worst, error / bound);
        ratios.within += error <= bound ? 1.0 : 0.0;
        inverse.push_back(bound / std::max(error, tolerance));
      }
    }
  }
  ratios.within /= static_cast<double>(inverse.size());
  std::nth_element(inverse.begin(), inverse.begin() + static_cast<std::ptrdiff_t>(inverse.size() / 2),
                   inverse.end());
  ratios.median = inverse[inverse.size() / 2];
  return ratios;
}

class StatedErrors : public testing::TestWithParam<std::pair<Kind, int>> {};

/// Families of each kind; EIGENTRAIL_FAMILIES asks for another number.
int number_of_families() {
  const char* asked = std::getenv("EIGENTRAIL_FAMILIES");
  return asked != nullptr ? std::atoi(asked) : 34;
}

/// Where the matrices are not smooth, few samples do not always tell how far they are off between them.
bool is_smooth(Kind kind) {
  return kind != Kind::root && kind != Kind::kink;
}

/// The true error is within the stated one, which is at most 30 times as large at the median.
TEST_P(StatedErrors, HoldAtRandomPlacesAndAreNotMuchLarger) {
  const auto [kind, samples] = GetParam();
  const Ratios found = study(kind, samples, number_of_families(), 20);
  RecordProperty("worst", std::to_string(found.worst));
  RecordProperty("median", std::to_string(found.median));
  RecordProperty("within", std::to_string(found.within));
  std::printf("worst true/stated %.2f, within %.4f, median stated/true %.1f\n", found.worst, found.within,
              found.median);
  if (is_smooth(kind)) {
    EXPECT_LT(found.worst, 2.0);
  }
  EXPECT_GE(found.within, is_smooth(kind) ? 0.999 : 0.99);
  EXPECT_LT(found.median, 30.0);
}

std::string name_of(const testing::TestParamInfo<std::pair<Kind, int>>& info) {
  const auto [kind, samples] = info.param;
  const char* name = kind == Kind::smooth   ? "Smooth"
                     : kind == Kind::pole   ? "Pole"
                     : kind == Kind::branch ? "Branch"
                     : kind == Kind::noise  ? "Noise"
                     : kind == Kind::root   ? "Root"
                                            : "Kink";
  return name + std::to_string(samples);
}

INSTANTIATE_TEST_SUITE_P(
    Families, StatedErrors,
    testing::Values(std::pair{Kind::smooth, 8}, std::pair{Kind::smooth, 12}, std::pair{Kind::smooth, 20},
                    std::pair{Kind::pole, 8}, std::pair{Kind::pole, 12}, std::pair{Kind::pole, 20},
                    std::pair{Kind::branch, 8}, std::pair{Kind::branch, 12}, std::pair{Kind::branch, 20},
                    std::pair{Kind::noise, 8}, std::pair{Kind::noise, 12}, std::pair{Kind::noise, 20},
                    std::pair{Kind::root, 8}, std::pair{Kind::root, 12}, std::pair{Kind::root, 20},
                    std::pair{Kind::kink, 8}, std::pair{Kind::kink, 12}, std::pair{Kind::kink, 20}),
    name_of);

/// x rounded to `digits` significant digits.
double rounded_to(double x, int digits) {
  if (x == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - digits + 1);
  return unit * std::round(x / unit);
}

TEST(DigitErrors, HoldForThousandRandomFamiliesRoundedToFourDigits) {
  double worst = 0.0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    std::mt19937_64 engine(seed);
    const Matrix A0 = random_matrix(size, size, engine), A1 = random_matrix(size, size, engine);
    const MatrixFunction truth = [&](double p) { return Matrix(A0 + p * A1); };
    SampledData data = sampled(truth, {0.0, 0.5, 1.0});
    for (Matrix& A : data.A) A = A.unaryExpr([](double x) { return rounded_to(x, 4); });
    data.digits = 4;
    const SampledScene scene(data);
    const Setting setting = scene.setting();
    const double p = std::uniform_real_distribution<double>(0.0, 1.0)(engine);
    RunCounts counts;
    const PathPoint point = point_from_guess(setting.problem(), p, counts);
    const std::vector<Complex> found = spectrum_of(-point.pencil.K[0]);
    const ComplexVector s = Eigen::Map<const ComplexVector>(found.data(), size);
    const Matrix stated = *data_errors_at(*setting.model, setting.options, p, s);
    const std::vector<Complex> exact = spectrum_of(truth(p));
    for (Eigen::Index k = 0; k < size; ++k) {
      double error = INFINITY;
      for (const Complex other : exact) error = std::min(error, std::abs(other - s[k]));
      worst = std::max(worst, error / (stated(k, 0) + stated(k, 1)));
    }
  }
  std::printf("worst error/stated %.2f\n", worst);
  EXPECT_LT(worst, 1.0);
}

/// A pair that crosses the imaginary axis at p = 0.4: s = 0.05 (p - 0.4) + i, and a stable real root.
Matrix crossing(double p) {
  Matrix A = Matrix::Zero(3, 3);
  A(0, 0) = A(1, 1) = 0.05 * (p - 0.4);
  A(0, 1) = 1.0;
  A(1, 0) = -1.0;
  A(2, 2) = -2.0 - std::exp(p);
  return A;
}

struct TracedScene : TracedPath {
  std::optional<DataErrors> errors;
  std::vector<StableRange> ranges;
};

TracedScene traced(const Setting& setting) {
  TracedScene traced{trace_path(*setting.model, setting.options), {}, {}};
  traced.errors = data_errors(*setting.model, setting.options, traced.path, traced.result.events);
  const EigenvalueAccuracy accuracy{setting.options.tolerance, traced.result.s_ref};
  traced.ranges = stable_ranges(traced.path, traced.result.events, accuracy);
  if (traced.errors)
    traced.ranges =
        with_undecided(traced.ranges, traced.path, traced.result.events, *traced.errors, accuracy);
  return traced;
}

TEST(DataErrors, VerdictIsUndecidedWhereTheIntervalHoldsZero) {
  SampledData data = sampled(crossing, sample_values(12, 0));
  for (Matrix& A : data.A) A = A.unaryExpr([](double x) { return rounded_to(x, 2); });
  data.digits = 2;
  const TracedScene found = traced(SampledScene(data).setting());
  ASSERT_TRUE(found.errors.has_value());
  ASSERT_GE(found.ranges.size(), 2u);
  EXPECT_EQ(found.ranges[0].kind, Stability::stable);
  EXPECT_EQ(found.ranges[1].kind, Stability::undecided);
  EXPECT_LT(found.ranges[1].from.p, 0.4);
  EXPECT_GT(found.ranges[1].to.p, 0.4);
  EXPECT_LT(found.ranges[1].to.p, 0.7);
  EXPECT_EQ(found.ranges[0].to.p, found.ranges[1].from.p);
  const auto flutter = std::find_if(found.result.events.begin(), found.result.events.end(),
                                    [](const Event& event) { return event.kind == EventKind::flutter; });
  ASSERT_NE(flutter, found.result.events.end());
  const EventInterval& interval =
      found.errors->intervals[static_cast<std::size_t>(flutter - found.result.events.begin())];
  EXPECT_LT(interval.from, 0.4);
  EXPECT_GT(interval.to, 0.4);
}

TEST(DataErrors, ExactSamplesOfALineLeaveNothingUndecided) {
  const MatrixFunction line = [](double p) {
    Matrix A = crossing(p);
    A(2, 2) = -3.0;
    return A;
  };
  const TracedScene found = traced(SampledScene(sampled(line, sample_values(8, 0))).setting());
  ASSERT_FALSE(found.ranges.empty());
  for (const StableRange& range : found.ranges) EXPECT_NE(range.kind, Stability::undecided);
  EXPECT_NEAR(found.ranges[0].to.p, 0.4, 1e-9);
  EXPECT_EQ(found.ranges[0].to.cause, "flutter");
}

/// Two samples say nothing about what is between them: the change of the eigenvalue is the measure.
TEST(DataErrors, OfTwoSamplesAreOfTheSizeOfTheChange) {
  const MatrixFunction curved = [](double p) { return Matrix{{-1.0 - p * p, 0.0}, {0.0, -9.0}}; };
  const SampledScene scene(sampled(curved, {0.0, 1.0}));
  const Setting setting = scene.setting();
  const Matrix stated = *data_errors_at(*setting.model, setting.options, 0.5, ComplexVector{{-1.5, -9.0}});
  EXPECT_GT(stated(0, 0), 0.25);  // the true error
  EXPECT_LT(stated(0, 0), 2.1);   // twice the change, and rounding
  EXPECT_LT(stated(1, 0), 1e-12);
}

/// What an interpolant misses vanishes at the samples; errors of the samples themselves do not.
TEST(DataErrors, AtASampleOnlyTheErrorsOfSamplesAreLeft) {
  std::mt19937_64 engine(3);
  const MatrixFunction truth = random_function(Kind::smooth, engine);
  const std::vector<double> values = sample_values(8, 0);
  const auto largest_at = [&](const SampledData& data, double p) {
    const SampledScene scene(data);
    const Setting setting = scene.setting();
    const std::vector<Complex> all = spectrum_of(truth(p));
    const ComplexVector s = Eigen::Map<const ComplexVector>(all.data(), size);
    return data_errors_at(*setting.model, setting.options, p, s)->col(0).maxCoeff();
  };
  const SampledData exact = sampled(truth, values);
  const double between = 0.5 * (values[3] + values[4]);
  EXPECT_LT(largest_at(exact, values[3]), 0.1 * largest_at(exact, between));
  SampledData noisy = exact;
  std::normal_distribution<double> normal;
  for (Matrix& A : noisy.A) A = A.unaryExpr([&](double x) { return x * (1.0 + 1e-2 * normal(engine)); });
  EXPECT_GT(largest_at(noisy, values[3]), 0.2 * largest_at(noisy, between));
}

TEST(DataErrors, ModelsWithoutDataHaveNone) {
  const Setting setting = scene_setting("rotating_mass");
  RecordedPath path;
  EXPECT_FALSE(data_errors(*setting.model, setting.options, path, {}).has_value());
}

}  // namespace
}  // namespace eigentrail::test::data_errors_test
