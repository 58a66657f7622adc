// Families that a function computes: how often it is called, what the interpolation misses, the trace, and
// what is refused.
#include "eigentrail/model/function_family.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/input_error.hpp"
#include "support/resumed.hpp"
#include "support/spectra.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test::function_family_test {
namespace {

/// A function with a record of its calls.
struct Recorded {
  FunctionFamily::Function function;
  std::shared_ptr<std::vector<double>> places = std::make_shared<std::vector<double>>();

  FunctionFamily::Function counted() const {
    return [function = function, places = places](double p) {
      places->push_back(p);
      return function(p);
    };
  }
};

/// Without a search for narrow features.
FunctionFamilyOptions range(double from, double to, double tolerance = 1e-11) {
  FunctionFamilyOptions options;
  options.from = from;
  options.to = to;
  options.tolerance = tolerance;
  options.resolution = 1.0;
  return options;
}

/// K(p) of a family at order 0.
Linearization at(const Model& model, double p, int order = 0) {
  Path path;
  path.parameters = (Matrix(1, 2) << p, 1.0).finished();
  path.x = Vector::Zero(model.n_coordinates());
  path.lambda = Vector();
  EvaluationCounts counts = model.new_counts();
  Linearization result;
  EXPECT_FALSE(model.linearize(path, order, result, counts));
  return result;
}

Matrix square(double a, double b, double c, double d) {
  return (Matrix(2, 2) << a, b, c, d).finished();
}

MatricesAt with_K(Matrix K) {
  const Eigen::Index n = K.rows();
  return {.M = Matrix::Identity(n, n), .C = {}, .K = std::move(K), .E = {}, .A = {}};
}

/// 9 points: polynomials up to degree 4 are those through 5 of them, which the other 4 confirm.
TEST(FunctionFamily, TakesNineCallsForPolynomialsUpToDegreeFour) {
  for (int degree = 0; degree <= 4; ++degree) {
    const Recorded recorded{
        [degree](double p) { return with_K(square(3.0 + std::pow(p, degree), 0.5, 0.5, 2.0)); }};
    const FunctionFamily family(recorded.counted(), range(-1.0, 3.0));
    EXPECT_EQ(family.calls(), 9) << degree;
    EXPECT_EQ(recorded.places->size(), 9U);
    ASSERT_EQ(family.pieces().size(), 1U);
    EXPECT_EQ(family.pieces()[0].degree, degree);
    EXPECT_EQ(family.structure(0).constant_stiffness, degree == 0);
    EXPECT_TRUE(family.structure(0).constant_mass);
    for (const double p : {-1.0, -0.3, 1.7, 3.0}) {
      const double exact = 3.0 + std::pow(p, degree);
      EXPECT_NEAR(at(family, p).K[0](0, 0), exact, 2e-14 * (3.0 + std::pow(3.0, degree)))
          << degree << " " << p;
    }
  }
}

/// A pole p0 beside the range [0, 1]: the coefficients decrease by rho = x0 + sqrt(x0^2 - 1) each, x0 = 1 - 2
/// p0. One piece needs log(1/tolerance)/log(rho) of them; more than 33 of them take pieces.
TEST(FunctionFamily, ResolvesAPoleBesideTheRange) {
  for (const double p0 : {-0.5, -0.1, -0.01}) {
    const Recorded recorded{[p0](double p) { return with_K(square(2.0 + 1.0 / (p - p0), 0.3, 0.3, 1.0)); }};
    const FunctionFamily family(recorded.counted(), range(0.0, 1.0, 1e-10));
    const double largest = 2.0 - 1.0 / p0;
    for (int i = 0; i <= 1000; ++i) {
      const double p = i / 1000.0;
      EXPECT_NEAR(at(family, p).K[0](0, 0), 2.0 + 1.0 / (p - p0), 1e-10 * largest) << p0 << " " << p;
    }
    // Pieces that double their length away from the pole: rho = 3 + sqrt(8) on each, with at most 17 or 33
    // points.
    const double pieces = std::max(1.0, std::ceil(std::log2(1.0 / std::abs(p0))));
    EXPECT_LE(family.calls(), 33 * (2 * pieces - 1)) << p0;
    EXPECT_EQ(family.calls(), static_cast<int>(recorded.places->size()));
    std::vector<double> places = *recorded.places;
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << "called twice at one place";
  }
}

/// A rotor-like family: gyroscopic, damped, with sines of the parameter.
MatricesAt smooth(double p) {
  Matrix M = square(2.0, 0.1, 0.1, 1.0 + 0.2 * std::cos(p));
  Matrix C = square(0.3, p, -p, 0.1 + std::abs(std::sin(0.5 + p / 8)));
  Matrix K = square(30.0 + std::sin(3 * p), std::exp(-p), -1.0, 12.0 + p * p);
  return {std::move(M), std::move(C), std::move(K), {}, {}};
}

TEST(FunctionFamily, EigenvaluesOfTheTraceAreThoseOfTheFunction) {
  const FunctionFamily family(smooth, range(0.0, 10.0, 1e-13));
  TraceOptions options = options_on(0.0, 10.0);
  options.tolerance = 1e-10;
  const auto [result, path] = trace_path(family, options);
  ASSERT_EQ(result.status, TraceStatus::completed) << result.message;
  EXPECT_TRUE(result.notes.empty());
  // sin(3 p) takes two pieces of 33 points: its coefficients J_k(7.5) are below 1e-14 from k = 29 on. The
  // first 17 calls show that one piece is not enough; the ends and the middle belong to these, too.
  EXPECT_EQ(family.pieces().size(), 2U);
  EXPECT_LE(family.calls(), 17 + 2 * (33 - 2));
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform(0.0, 10.0);
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double p = uniform(engine);
    const MatricesAt exact = smooth(p);
    const std::vector<Complex> all = quadratic_eigenvalues(exact.M, exact.C, exact.K);
    const std::vector<PathPosition> places = path.positions(p);
    ASSERT_EQ(places.size(), 1U);
    for (const Complex s : path.eigenvalues_at(places[0])) worst = std::max(worst, relative_distance(s, all));
  }
  EXPECT_LT(worst, 1e-10);
}

TEST(FunctionFamily, JoiningPiecesDoNotDisturbTheTrace) {
  FunctionFamilyOptions in_pieces = range(0.0, 10.0, 1e-12);
  in_pieces.breaks = {1.3, 2.9, 4.4, 5.1, 6.6, 8.2};
  const FunctionFamily many(smooth, in_pieces), few(smooth, range(0.0, 10.0, 1e-12));
  EXPECT_GE(many.pieces().size(), 7U);
  TraceOptions options = options_on(0.0, 10.0);
  options.tolerance = 1e-8;
  const TraceResult in_many = trace(many, options, {}), in_few = trace(few, options, {});
  EXPECT_EQ(in_many.status, TraceStatus::completed) << in_many.message;
  EXPECT_EQ(in_few.status, TraceStatus::completed) << in_few.message;
  EXPECT_NEAR(in_many.nodes, in_few.nodes, 2);
  EXPECT_EQ(in_many.events.size(), in_few.events.size());
}

TEST(FunctionFamily, ResumedTracesAreTheSameBitForBit) {
  const FunctionFamily family(smooth, range(0.0, 10.0));
  EXPECT_EQ(first_resumed_difference(family, options_on(10.0, 0.0), 4), "");
}

TEST(FunctionFamily, FirstOrderFormIsThatOfAMatrixFamily) {
  const auto states = [](double p) {
    return MatricesAt{{}, {}, {}, square(1, 0, 0, 2), square(0, 1, -4 - p, -1)};
  };
  const FunctionFamily family(states, range(0.0, 1.0));
  const Linearization lin = at(family, 0.5);
  EXPECT_TRUE(lin.M[0].is_zero());
  EXPECT_NEAR((lin.C[0].dense() - square(1, 0, 0, 2)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((lin.K[0].dense() - square(0, -1, 4.5, 1)).norm(), 0.0, 1e-13);
  const FunctionFamily without_E(
      [&](double p) {
        return MatricesAt{{}, {}, {}, {}, states(p).A};
      },
      range(0.0, 1.0));
  EXPECT_EQ(at(without_E, 0.5).C[0].dense(), Matrix(Matrix::Identity(2, 2)));
  const TraceResult result = trace(family, options_on(0.0, 1.0), {});
  EXPECT_EQ(result.status, TraceStatus::completed) << result.message;
  EXPECT_EQ(result.n_infinite, 0);
}

TEST(FunctionFamily, StructureIsThatOfTheEntries) {
  const auto structure = [](const Matrix& C, const Matrix& K) {
    return FunctionFamily(
               [&](double p) {
                 return MatricesAt{Matrix::Identity(2, 2), p * C, K, {}, {}};
               },
               range(1.0, 2.0))
        .structure(0);
  };
  const Structure undamped = structure(Matrix::Zero(2, 2), square(1, 2, 2, 5));
  EXPECT_FALSE(undamped.damped || undamped.gyroscopic || undamped.circulatory);
  const Structure rotor = structure(square(0, 1, -1, 0), square(1, 2, 2, 5));
  EXPECT_TRUE(rotor.gyroscopic && !rotor.damped && !rotor.circulatory);
  const Structure flutter = structure(square(1, 0, 0, 1), square(1, 2, -2, 5));
  EXPECT_TRUE(flutter.damped && !flutter.gyroscopic && flutter.circulatory);
}

/// Entries that are rounding beside large ones are not resolved.
TEST(FunctionFamily, RoundingOfTheFunctionCostsNoCalls) {
  const FunctionFamily family(
      [](double p) { return with_K(square(1e6 * (2.0 + p), 1e-11 * std::sin(1e5 * p), 0.0, 3e6)); },
      range(0.0, 1.0));
  EXPECT_EQ(family.calls(), 9);
}

TEST(FunctionFamily, AKinkAtAKnownPlaceIsABreak) {
  const auto kink = [](double p) { return with_K(square(5.0 + std::abs(p - 0.3), 1, 1, 2.0)); };
  FunctionFamilyOptions options = range(0.0, 1.0);
  options.breaks = {0.3};
  const FunctionFamily family(kink, options);
  EXPECT_EQ(family.pieces().size(), 2U);
  EXPECT_EQ(family.calls(), 17);  // twice 9, the place itself once
}

/// The error of a function whose pieces do not become short enough within the calls.
std::string expect_not_resolved(const FunctionFamily::Function& function, int max_calls, double longest) {
  const Recorded recorded{function};
  FunctionFamilyOptions options = range(0.0, 1.0);
  options.max_calls = max_calls;
  try {
    const FunctionFamily family(recorded.counted(), options);
  } catch (const NotResolved& error) {
    EXPECT_LE(error.from, 0.3);
    EXPECT_GE(error.to, 0.3);
    EXPECT_LT(error.to - error.from, longest);
    EXPECT_LE(recorded.places->size(), static_cast<std::size_t>(max_calls));
    return error.what();
  }
  return "no error";
}

TEST(FunctionFamily, AnUnknownKinkIsReportedWithItsPlace) {
  const std::string text = expect_not_resolved(
      [](double p) { return with_K(square(5, 1, 1, 2.0 + std::abs(p - 0.3))); }, 100, 0.1);
  EXPECT_NE(text.find("100 calls are not enough for the tolerance 1e-11: between p = "), std::string::npos)
      << text;
  EXPECT_NE(text.find("the entry K(1, 1) is off by"), std::string::npos) << text;
  EXPECT_NE(text.find("Name the place in breaks"), std::string::npos) << text;
}

TEST(FunctionFamily, AJumpIsReportedWithItsPlace) {
  const std::string text =
      expect_not_resolved([](double p) { return with_K(square(p > 0.3 ? 5 : 6, 1, 1, 2)); }, 5000, 1e-9);
  EXPECT_NE(text.find("no pieces are short enough"), std::string::npos) << text;
  EXPECT_NE(text.find("K(0, 0)"), std::string::npos) << text;
}

/// With calls enough, pieces become so short that the kink is within the tolerance, 1e-8 of 5.7. It has its
/// place in the description of the model.
TEST(FunctionFamily, AKinkIsResolvedByShortPiecesIfCallsAllow) {
  const FunctionFamily family([](double p) { return with_K(square(5.0 + std::abs(p - 0.3), 1, 1, 2.0)); },
                              range(0.0, 1.0, 1e-8));
  EXPECT_GT(family.pieces().size(), 10U);
  const std::string text = family.description().data.front().second;
  EXPECT_NE(text.find("kinks: at p = 0.3"), std::string::npos) << text;
  EXPECT_FALSE(family.landings(0).empty());
  for (int i = 0; i <= 2000; ++i) {
    const double p = 0.3 + std::copysign(0.3 * std::pow(0.98, i), i % 2 - 0.5);
    ASSERT_NEAR(at(family, p).K[0](0, 0), 5.0 + std::abs(p - 0.3), 5.7e-8) << p;
  }
}

/// The largest error of a trace of a bump of 25 % of the stiffness, 4, beside its centre.
double error_at_bump(double centre, double width, double resolution) {
  const auto stiffness = [&](double p) { return 4.0 + std::exp(-std::pow((p - centre) / width, 2)); };
  FunctionFamilyOptions options = range(0.0, 1.0);
  options.resolution = resolution;
  const FunctionFamily family([&](double p) { return with_K(Matrix::Constant(1, 1, stiffness(p))); },
                              options);
  const auto [result, path] = trace_path(family, options_on(0.0, 1.0));
  EXPECT_EQ(result.status, TraceStatus::completed);
  double worst = 0.0;
  for (double p = centre - 2.0 * width; p <= centre + 2.0 * width; p += 0.1 * width) {
    const double found = path.eigenvalues_at(path.positions(p).at(0))[0].imag();
    worst = std::max(worst, std::abs(found - std::sqrt(stiffness(p))));
  }
  return worst;
}

/// Nine calls see few of them.
TEST(FunctionFamily, BumpsAsWideAsTheResolutionAreFound) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> place(0.1, 0.9);
  int missed = 0;
  for (int i = 0; i < 16; ++i) {
    const double centre = place(engine), width = i % 2 == 0 ? 0.01 : 0.002;
    EXPECT_LT(error_at_bump(centre, width, width), 1e-5) << width << " " << centre;
    missed += error_at_bump(centre, width, 1.0) > 1e-2 ? 1 : 0;
  }
  EXPECT_GT(missed, 8);
}

struct OwnError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(FunctionFamily, ErrorsOfTheFunctionPassThrough) {
  EXPECT_THROW(FunctionFamily(
                   [](double p) -> MatricesAt {
                     if (p > 0.5) throw OwnError("the other program has stopped");
                     return with_K(square(1, 0, 0, 1));
                   },
                   range(0.0, 1.0)),
               OwnError);
}

struct Refused {
  std::string name;
  FunctionFamily::Function function;
  FunctionFamilyOptions options;
  std::string message;
};

class RefusedFunctions : public testing::TestWithParam<Refused> {};

TEST_P(RefusedFunctions, SayWhatWasExpected) {
  const std::string message = error_text<std::invalid_argument>(
      [] { const FunctionFamily family(GetParam().function, GetParam().options); });
  EXPECT_TRUE(contains(message, GetParam().message)) << message;
}

const auto good = [](double p) { return with_K(square(2 + p, 0, 0, 1)); };

FunctionFamilyOptions changed(void (*change)(FunctionFamilyOptions&)) {
  FunctionFamilyOptions options = range(0.0, 1.0);
  change(options);
  return options;
}

INSTANTIATE_TEST_SUITE_P(
    Faults, RefusedFunctions,
    testing::Values(
        Refused{"not_a_number", [](double p) { return with_K(square(1, 0, p > 0.4 ? NAN : 0.0, 1)); },
                range(0, 1), "entry K(1, 0) is not a finite number"},
        Refused{"infinite", [](double p) { return with_K(square(1 / p, 0, 0, 1)); }, range(0, 1),
                "at p = 0 entry K(0, 0) is not a finite number"},
        Refused{"another_size", [](double p) { return p > 0.5 ? good(p) : with_K(Matrix::Identity(3, 3)); },
                range(0, 1), "of 3 x 3; expected 2 x 2"},
        Refused{"not_square",
                [](double) {
                  return MatricesAt{{}, {}, Matrix::Zero(2, 3), {}, {}};
                },
                range(0, 1), "neither A nor K with M or C"},
        Refused{"K_not_square",
                [](double) {
                  return MatricesAt{Matrix::Zero(2, 2), {}, Matrix::Zero(2, 3), {}, {}};
                },
                range(0, 1), "K of 2 x 3; expected 2 x 2"},
        Refused{"sometimes_C",
                [](double p) {
                  MatricesAt matrices = good(p);
                  if (p < 0.5) matrices.C = Matrix::Zero(2, 2);
                  return matrices;
                },
                range(0, 1), "C of 2 x 2; expected none"},
        Refused{"both_forms",
                [](double) {
                  return MatricesAt{Matrix::Zero(2, 2), {}, {}, {}, Matrix::Zero(2, 2)};
                },
                range(0, 1), "A of E x' = A x beside M, C or K"},
        Refused{"nothing", [](double) { return MatricesAt{}; }, range(0, 1), "neither A nor K"},
        Refused{"empty_range", good, range(1, 1), "from < to"},
        Refused{"endless_range", good, range(0, INFINITY), "finite"},
        Refused{"no_tolerance", good, range(0, 1, 0.0), "tolerance"},
        Refused{"no_calls", good, changed([](auto& o) { o.max_calls = 1; }), "max_calls"},
        Refused{"a_break_outside", good, changed([](auto& o) { o.breaks = {2.0}; }), "breaks"},
        Refused{"too_few_names", good, changed([](auto& o) { o.state_names = {"a"}; }), "expected 2 texts"}),
    [](const auto& tested) { return tested.param.name; });

TEST(FunctionFamily, EndsWhereItsRangeDoes) {
  const FunctionFamily family(good, range(0.0, 1.0));
  Path path{Vector::Constant(1, 1.5), Vector::Zero(2), Vector()};
  EvaluationCounts counts = family.new_counts();
  Linearization result;
  EXPECT_NE(family.linearize(path, 0, result, counts).source.find("p = 0 and 1"), std::string::npos);
  const TraceResult outcome = trace(family, options_on(0.5, 2.0), {});
  EXPECT_NE(outcome.status, TraceStatus::completed);
  EXPECT_NE(outcome.message.find("the function family, which ends at p = 0 and 1"), std::string::npos)
      << outcome.message;
}

TEST(FunctionFamily, ExtendedPrecisionIsThatOfTheSamePolynomials) {
  const FunctionFamily family(smooth, range(0.0, 10.0));
  BasicPath<Extended> path{ExtendedMatrix::Constant(1, 1, Extended(3.7)), ExtendedMatrix::Zero(2, 1),
                           ExtendedMatrix(0, 1)};
  BasicLinearization<Extended> exact;
  ASSERT_FALSE(family.extended_linearization(path, exact));
  EXPECT_LT((to_double(exact.K[0].dense()) - at(family, 3.7).K[0].dense()).norm(), 1e-13 * 120);
}

}  // namespace
}  // namespace eigentrail::test::function_family_test
