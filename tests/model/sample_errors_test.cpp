// Stated errors between samples of scalar functions, and how much each number that they depend on decides.
#include "eigentrail/model/sample_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/gaps.hpp"
#include "model/sample_interpolation.hpp"
#include "support/sampled.hpp"

namespace eigentrail::test::sample_errors_test {
namespace {

using Function = std::function<double(double)>;

/// Smooth, with a pole or a branch point beside the range, with noise, with a square root at an end, with a
/// kink.
constexpr int n_kinds = 6;
constexpr int noise = 3;

Function random_function(int kind, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double a = uniform(engine) - 0.5, rate = 4.0 + 4.0 * uniform(engine), phase = 6.0 * uniform(engine);
  const double place = -0.05 - 0.25 * uniform(engine), corner = 0.2 + 0.6 * uniform(engine);
  switch (kind) {
    case 1:
      return [=](double p) { return a * p + 0.1 / (p - place); };
    case 2:
      return [=](double p) { return a * p + 0.3 / std::sqrt(p - place); };
    case 4:
      return [=](double p) { return a * p + std::sqrt(std::max(p, 0.0)); };
    case 5:
      return [=](double p) { return a * p + std::abs(p - corner); };
    default:
      return [=](double p) { return a * p * p + 0.5 * std::sin(rate * p + phase); };
  }
}

struct Found {
  double within = 0.0;  ///< share of places at which the true error is at most the stated one
  double median = 0.0;  ///< of stated / true
};

/// A sampled function, and random places between its samples.
struct Family {
  Function truth;
  SampledData data;
  std::vector<SamplePiece> pieces;
  std::array<PencilSamples, 3> pencil;
  std::vector<double> places;
};

/// Of all kinds, with 8, 12 and 20 samples.
std::vector<Family> random_families() {
  constexpr int families = 20, places = 10;
  std::vector<Family> all;
  for (int kind = 0; kind < n_kinds; ++kind) {
    for (const int samples : {8, 12, 20}) {
      for (int family = 0; family < families; ++family) {
        std::mt19937_64 engine(static_cast<unsigned>(1000 * kind + 100 * samples + family));
        const Function truth = random_function(kind, engine);
        std::normal_distribution<double> normal;
        SampledData data = sampled(
            [&](double p) {
              return Matrix::Constant(1, 1, truth(p) * (1.0 + (kind == noise ? 1e-4 * normal(engine) : 0.0)));
            },
            sample_values(samples, static_cast<unsigned>(family + 1)));
        const std::vector<SamplePiece> pieces = interpolate_samples(data, data.values, {}, std::nullopt);
        std::vector<Matrix> K;
        for (const Matrix& A : data.A) K.push_back(-A);
        const std::array<PencilSamples, 3> pencil{PencilSamples{2, {Matrix::Zero(1, 1)}},
                                                  PencilSamples{1, {Matrix::Identity(1, 1)}},
                                                  PencilSamples{0, K}};
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        std::vector<double> at(places);
        for (double& p : at) p = uniform(engine);
        all.push_back({truth, data, pieces, pencil, at});
      }
    }
  }
  return all;
}

/// Of all families together.
Found study(const std::vector<Family>& families, const SampleErrorOptions& options) {
  std::vector<double> ratios;
  for (const Family& family : families) {
    const std::vector<double>& values = family.data.values;
    const InterpolationErrors errors(0, values, family.pencil, family.pieces, options);
    for (const double p : family.places) {
      const Vector weights = family.pieces[0].interpolant.values(p);
      double s = 0.0;
      for (Eigen::Index j = 0; j < weights.size(); ++j)
        s += weights[j] * family.data.A[static_cast<std::size_t>(j)](0, 0);
      const EigenTriple triple{s, ComplexVector::Ones(1), ComplexVector::Ones(1)};
      const double stated = errors.between(gap_of(values, p), {&triple, 1}).interpolation(errors.shape(p))[0];
      ratios.push_back((stated + 1e-13) / std::max(std::abs(s - family.truth(p)), 1e-13));
    }
  }
  Found found;
  const auto count = static_cast<double>(ratios.size());
  found.within =
      static_cast<double>(std::count_if(ratios.begin(), ratios.end(), [](double x) { return x >= 1.0; })) /
      count;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  found.median = *middle;
  return found;
}

struct Varied {
  const char* name;
  double SampleErrorOptions::*option;
  double less, more;  ///< three times less and more of what it stands for
};

/// One function alone shows least: what is smooth in it and what is not cannot be told apart by others.
TEST(SampleErrorOptions, ThreeTimesMoreOrLessOfEachChangesWhatIsStatedLittle) {
  const SampleErrorOptions usual;
  const std::vector<Family> families = random_families();
  const Found found = study(families, usual);
  EXPECT_GE(found.within, 0.998);
  EXPECT_LT(found.median, 40.0);
  const auto thrice = [](const char* name, double SampleErrorOptions::*option) {
    const double value = SampleErrorOptions{}.*option;
    return Varied{name, option, value / 3.0, 3.0 * value};
  };
  const Varied all[] = {thrice("safety", &SampleErrorOptions::safety),
                        // What the ratios of errors lack of one, and by how much they differ from one.
                        {"slowest", &SampleErrorOptions::slowest, 1.0 - 3.0 * (1.0 - usual.slowest),
                         1.0 - (1.0 - usual.slowest) / 3.0},
                        {"worth_a_degree", &SampleErrorOptions::worth_a_degree,
                         1.0 + (usual.worth_a_degree - 1.0) / 3.0, 1.0 + 3.0 * (usual.worth_a_degree - 1.0)},
                        thrice("may_have_kinks", &SampleErrorOptions::may_have_kinks),
                        thrice("beside_a_kink", &SampleErrorOptions::beside_a_kink),
                        thrice("at_an_end", &SampleErrorOptions::at_an_end),
                        thrice("leave_one_out", &SampleErrorOptions::leave_one_out),
                        thrice("deviations", &SampleErrorOptions::deviations),
                        thrice("deviations_nearby", &SampleErrorOptions::deviations_nearby)};
  for (const Varied& one : all) {
    for (const double value : {one.less, one.more}) {
      SampleErrorOptions options;
      options.*one.option = value;
      const Found varied = study(families, options);
      EXPECT_GE(varied.within, 0.98) << one.name << " = " << value;
      EXPECT_GT(varied.median, found.median / 3.0) << one.name << " = " << value;
      EXPECT_LT(varied.median, found.median * 3.0) << one.name << " = " << value;
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::sample_errors_test
