// Sampled families: the interpolant, its degree, kinks, names of states, and files that are refused.
#include "model/sampled_family.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/hdf5_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "scene/input_error.hpp"
#include "support/families.hpp"
#include "support/sampled.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::sampled_family_test {
namespace {

const std::vector<double> uneven{-1.0, -0.7, -0.1, 0.2, 0.9, 1.5, 1.6};

double cubic(double x) {
  return 2.0 - 3.0 * x + 0.5 * x * x - x * x * x;
}

/// Largest error of an interpolant of f between the nodes.
double largest_error(const RationalInterpolant& interpolant, const std::function<double(double)>& f) {
  Vector values(static_cast<Eigen::Index>(interpolant.nodes().size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = f(interpolant.nodes()[static_cast<std::size_t>(i)]);
  double largest = 0.0;
  const double from = interpolant.nodes().front(), to = interpolant.nodes().back();
  for (int i = 0; i <= 500; ++i) {
    const double x = from + (to - from) * i / 500.0;
    largest = std::max(largest, std::abs(interpolant.values(x).dot(values) - f(x)));
  }
  return largest;
}

TEST(RationalInterpolant, ReproducesPolynomialsUpToItsDegree) {
  EXPECT_LT(largest_error({uneven, 3}, cubic), 1e-14);
  EXPECT_GT(largest_error({uneven, 2}, cubic), 1e-3);
}

TEST(RationalInterpolant, SeriesAreThoseOfThePolynomialAlsoAtNodes) {
  const RationalInterpolant interpolant(uneven, 3);
  for (const double x : {-1.0, 0.2, 0.35, 1.6}) {
    Series<double, 4> series(x);
    series[1] = 1.0;
    const auto basis = interpolant.basis(series);
    Series<double, 4> sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * cubic(uneven[i]);
    const double expected[] = {cubic(x), -3.0 + x - 3.0 * x * x, 0.5 - 3.0 * x, -1.0, 0.0};
    for (int k = 0; k <= 4; ++k) EXPECT_NEAR(sum[k], expected[k], 1e-11) << x << " order " << k;
  }
}

TEST(RationalInterpolant, ErrorFallsWithThePowerOfTheDistanceAboveItsDegree) {
  const auto f = [](double x) { return std::exp(2.0 * x); };
  for (const int degree : {1, 2, 3, 5}) {
    const double coarse = largest_error({sample_values(21, 0), degree}, f);
    const double fine = largest_error({sample_values(41, 0), degree}, f);
    EXPECT_NEAR(std::log2(coarse / fine), degree + 1, 0.6) << degree;
  }
}

TEST(RationalInterpolant, HasNoPolesWhereThePolynomialOfFullDegreeDiverges) {
  const auto runge = [](double x) { return 1.0 / (1.0 + 100.0 * (x - 0.5) * (x - 0.5)); };
  const std::vector<double> values = sample_values(31, 0);
  EXPECT_LT(largest_error({values, 3}, runge), 1e-2);
  EXPECT_GT(largest_error({values, 30}, runge), 1.0) << "the rival";
}

MatrixFunction pole(double distance) {
  return [distance](double p) {
    Matrix A(2, 2);
    A << -1.0 - 0.1 / (p + distance), 3.0, -3.0, -2.0 + p;
    return A;
  };
}

double error_in_first_entry(const MatrixFunction& A, const SampledData& data, std::optional<int> degree) {
  const auto pieces = interpolate_samples(data, data.values, {}, degree);
  return largest_error(pieces[0].interpolant, [&](double p) { return A(p)(0, 0); });
}

TEST(SampledFamily, ChosenDegreeBeatsCubicPieces) {
  const MatrixFunction A = [](double p) { return Matrix{{-1.0 - std::sin(5.0 * p), 3.0}, {-3.0, -2.0 + p}}; };
  const SampledData data = sampled(A, sample_values(20, 3));
  const auto pieces = interpolate_samples(data, data.values, {}, std::nullopt);
  EXPECT_GT(pieces[0].interpolant.degree(), 5);
  EXPECT_LT(error_in_first_entry(A, data, std::nullopt), 1e-3 * error_in_first_entry(A, data, 3));
}

TEST(SamplePoles, RealPoleAndPairAreFoundExactly) {
  const SampledData real = sampled(pole(0.2), sample_values(8, 3));
  const RationalInterpolant found = interpolate_samples(real, real.values, {}, std::nullopt)[0].interpolant;
  ASSERT_EQ(found.denominator().poles.size(), 1u);
  EXPECT_NEAR(found.denominator().poles[0].real(), -0.2, 1e-10);
  EXPECT_EQ(found.denominator().poles[0].imag(), 0.0);
  EXPECT_LT(error_in_first_entry(pole(0.2), real, std::nullopt), 1e-12);
  EXPECT_GT(error_in_first_entry(pole(0.2), real, 6), 1e-5) << "the rival";

  const MatrixFunction resonance = [](double p) {
    return Matrix{{-1.0, 1.0 / (0.04 + (p - 0.3) * (p - 0.3))}, {-3.0, -2.0 + p}};
  };
  const SampledData pair = sampled(resonance, sample_values(12, 3));
  const RationalInterpolant two = interpolate_samples(pair, pair.values, {}, std::nullopt)[0].interpolant;
  ASSERT_EQ(two.denominator().poles.size(), 1u);
  EXPECT_LT(std::abs(two.denominator().poles[0] - Complex(0.3, 0.2)), 1e-9);
}

/// Functions that are no quotients of polynomials, few samples and noise must not be taken for poles; a pole
/// between the samples cannot be interpolated and is not tried.
TEST(SamplePoles, AreNotSeenWhereThereAreNone) {
  const auto n_poles = [](const MatrixFunction& A, int samples) {
    const SampledData data = sampled(A, sample_values(samples, 2));
    return interpolate_samples(data, data.values, {}, std::nullopt)[0].interpolant.denominator().degree();
  };
  const MatrixFunction smooth = [](double p) {
    return Matrix{{-1.0, std::sin(4.0 * p)}, {std::exp(p), -2.0 + p}};
  };
  EXPECT_EQ(n_poles(smooth, 8), 0);
  EXPECT_EQ(n_poles(pole(0.2), 4), 0);
  EXPECT_EQ(n_poles(pole(-0.47), 12), 0);
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937_64 engine(seed);
    EXPECT_EQ(n_poles([&](double p) { return Matrix(p * random_matrix(2, 2, engine)); }, 12), 0) << seed;
  }
}

TEST(SampledFamily, NoiseIsInterpolatedWithALowDegree) {
  std::mt19937_64 engine(5);
  const MatrixFunction A = [&](double p) {
    return Matrix(pole(0.5)(p) + 1e-2 * random_matrix(2, 2, engine));
  };
  const SampledData data = sampled(A, sample_values(20, 1));
  EXPECT_LE(interpolate_samples(data, data.values, {}, std::nullopt)[0].interpolant.degree(), 3);
}

TEST(SampledFamily, LociPassThroughTheEigenvaluesOfTheSamples) {
  const SampledData data = sampled(pole(0.3), sample_values(9, 7));
  const SampledScene scene(data, "", "from = 0\nto = 1\ntolerance = 1e-11\n");
  const RecordedTrace trace = completed_trace(scene.setting());
  EXPECT_EQ(trace.result.certified_steps, trace.result.mode_steps);
  for (std::size_t i = 0; i < data.count(); ++i) {
    const Eigen::EigenSolver<Matrix> expected(data.A[i]);
    const Complex s = trace.eigenvalues_at(data.values[i])[0];
    EXPECT_LT(std::abs(s - (expected.eigenvalues()[0].imag() > 0 ? expected.eigenvalues()[0]
                                                                 : expected.eigenvalues()[1])),
              1e-10);
  }
}

TEST(SampledFamily, SecondOrderSamplesOfPolynomialsAreThePolynomialFamily) {
  SampledData data;
  data.values = {0.0, 0.3, 0.5, 0.8, 1.4, 2.0};
  Matrix M(2, 2), C(2, 2), K0(2, 2), K1(2, 2);
  M << 1, 0, 0, 2;
  C << 0.1, 0.5, -0.5, 0.2;
  K0 << 2, 0, 0, 9;
  K1 << 1, 0.3, 0.2, 0;
  for (const double p : data.values) {
    data.M.push_back(M);
    data.C.push_back(C);
    data.K.push_back(K0 + p * K1);
  }
  const SampledScene scene(data, "", "from = 0\nto = 2\ntolerance = 1e-9\n");
  const Setting setting = scene.setting();
  const Structure structure = setting.model->structure(setting.traced());
  EXPECT_TRUE(structure.constant_mass && structure.constant_damping && !structure.constant_stiffness);
  const RecordedTrace trace = record_trace(setting);
  for (const double p : {0.0, 0.37, 1.1, 2.0}) {
    const std::vector<Complex> exact = quadratic_eigenvalues(M, C, K0 + p * K1);
    const ComplexVector found = trace.eigenvalues_at(p);
    ASSERT_EQ(found.size(), 2);
    for (const Complex s : found) EXPECT_LT(relative_distance(s, exact), 1e-8) << p;
  }
}

/// A(p) with a kink at p = 0.5.
Matrix kinked(double p) {
  Matrix A(2, 2);
  A << -1.0 + std::abs(p - 0.5), 2.0, -2.0, -1.0 - 0.5 * p;
  return A;
}

TEST(SampledFamily, DeclaredKinksSplitTheInterpolant) {
  std::vector<double> values;
  for (int i = 0; i <= 8; ++i) values.push_back(i / 8.0);
  const SampledData data = sampled(kinked, values);
  const auto error = [&](const SampledScene& scene) {
    const Setting setting = scene.setting();
    const RecordedTrace trace = completed_trace(setting);
    double largest = 0.0;
    for (double p = 0.01; p < 1.0; p += 0.0173) {
      const ComplexVector exact = Eigen::EigenSolver<Matrix>(kinked(p)).eigenvalues();
      largest = std::max(largest, relative_distance(trace.eigenvalues_at(p)[0], {exact[0], exact[1]}));
    }
    return largest;
  };
  EXPECT_LT(error(SampledScene(data, "kinks = [0.5]\n")), 1e-9);
  EXPECT_LT(error(SampledScene(data, "kinks = [0.5]\n", "from = 1\nto = 0\ntolerance = 1e-10\n")), 1e-9)
      << "backwards";
  EXPECT_GT(error(SampledScene(data)), 1e-4) << "not declared";
}

TEST(SampledFamily, StatesAreMatchedByNameWhereTheirOrderChanges) {
  const MatrixFunction A = pole(0.4);
  SampledData data = sampled(A, sample_values(6, 2));
  data.state_names = {"flap", "lag"};
  const SampledScene scene(data);
  // The same samples, every second one with its states in the other order.
  {
    Hdf5Writer file = Hdf5Writer::in_memory(scene.file());
    file.create_dataset({"parameter", ElementType::real, {6}, false, {{"units", "1"}}});
    file.write_rows("parameter", 0, data.values);
    std::vector<double> numbers;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < 6; ++i) {
      const bool swapped = i % 2 == 1;
      for (const Eigen::Index row : {0, 1}) {
        for (const Eigen::Index column : {0, 1})
          numbers.push_back(swapped ? data.A[i](1 - row, 1 - column) : data.A[i](row, column));
      }
      names.insert(names.end(), {swapped ? "lag" : "flap", swapped ? "flap" : "lag"});
    }
    file.create_dataset({"A", ElementType::real, {6, 2, 2}, false, {}});
    file.write_rows("A", 0, numbers);
    file.create_dataset({"state_names", ElementType::text, {6, 2}, false, {}});
    file.write_rows("state_names", 0, names);
    write_durably(scene.file(), {file.image()}, Existing::replace);
  }
  const SampledData read = read_samples(scene.file());
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(read.A[i], data.A[i]) << i;
}

TEST(SampledFamily, ScenesThatCannotBeMeantAreRefused) {
  const SampledData data = sampled(pole(0.4), {0.0, 0.25, 0.5, 1.0});
  const auto message = [&](const std::string& keys, const std::string& trace) {
    const SampledScene scene(data, keys, trace);
    return input_error([&] { scene.setting(); });
  };
  const std::string range = "from = 0\nto = 1\n";
  EXPECT_TRUE(contains(message("", "from = -0.1\nto = 1\n"),
                       "p = -0.1 lies outside the samples, which reach from 0 to 1"));
  EXPECT_TRUE(contains(message("", "from = 0\nto = 1.5\n"), "p = 1.5 lies outside"));
  EXPECT_TRUE(contains(message("kinks = [0.3]\n", range),
                       "0.3 is not among the samples; the nearest one is at 0.25"));
  EXPECT_TRUE(contains(message("degree = 0\n", range), "expected a whole number from 1 to 15"));
  EXPECT_TRUE(contains(message("digits = 40\n", range), "expected a whole number from 1 to 17"));
  EXPECT_TRUE(contains(message("degrees = 3\n", range), "degrees: unknown key"));
  EXPECT_TRUE(
      contains(message("[[spring]]\n", range), "spring: unknown key in a scene with [sampled_family]"));
}

TEST(SampledFamily, FilesThatDoNotFitAreRefused) {
  const auto message = [](const std::function<void(SampledData&)>& spoil) {
    SampledData data = sampled(pole(0.4), {0.0, 0.25, 0.5, 1.0});
    spoil(data);
    return error_text<std::invalid_argument>([&] { check(data); });
  };
  EXPECT_EQ(message([](SampledData&) {}), "no error was thrown");
  EXPECT_TRUE(contains(message([](SampledData& d) { d.A.pop_back(); }), "A has 3 samples for 4 values"));
  EXPECT_TRUE(contains(message([](SampledData& d) { d.A[2] = Matrix::Zero(3, 3); }),
                       "A, sample 3 is 3 x 3; expected 2 x 2"));
  EXPECT_TRUE(contains(message([](SampledData& d) { d.A[1](0, 0) = NAN; }),
                       "A, sample 2 has an entry that is not finite"));
  EXPECT_TRUE(contains(message([](SampledData& d) { d.values[1] = 0.5; }), "has the value 0.5 twice"));
  EXPECT_TRUE(contains(message([](SampledData& d) { d.K = d.A; }), "cannot stand beside M, C or K"));
  EXPECT_TRUE(contains(message([](SampledData& d) { d.state_names = {"a"}; }),
                       "state_names has 1 entry; expected 2"));
  EXPECT_TRUE(contains(message([](SampledData& d) { d.digits = 0; }), "digits: expected 1 to 17"));
}

}  // namespace
}  // namespace eigentrail::test::sampled_family_test
