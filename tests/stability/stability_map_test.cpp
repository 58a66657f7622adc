// Stability maps compared with closed forms and with QZ in every cell, and cells that a trace does not reach.
#include "eigentrail/stability/stability_map.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::stability_map_test {
namespace {

struct Window {
  std::string second;
  double from, to;
  int n_second, n_first;
};

MapSetup map_setup(const std::string& scene, const Window& window, const OptionTexts& overrides = {}) {
  return prepare_map(parse_scene(scene, "test.toml"), overrides,
                     {window.second, window.from, window.to, window.n_second, window.n_first});
}

/// Calls visit(line, cell, p) for every cell.
template <class Visitor>
void for_cells(const StabilityMap& map, Visitor&& visit) {
  for (const MapLine& line : map.lines) {
    for (std::size_t cell = 0; cell < map.first.size(); ++cell) visit(line, cell, map.first[cell]);
  }
}

/// Modes with a positive real part, a pair counted once.
int growing(const std::vector<Complex>& spectrum) {
  int count = 0;
  for (const Complex s : spectrum) count += s.real() > 0.0 && s.imag() >= 0.0 ? 1 : 0;
  return count;
}

double fastest(const std::vector<Complex>& spectrum) {
  double result = -INFINITY;
  for (const Complex s : spectrum) result = std::max(result, s.real());
  return result;
}

/// s^2 + c s + k = 0 with c = p^2 + q^2 - 1 and k = 0.8 - p - q: a circle of flutter, a line of divergence
/// that cuts it, and real roots that meet.
const std::string circle =
    "[parameters]\np = 0.0\nq = 0.0\n\n[trace]\nparameter = \"p\"\nfrom = -1.5\nto = 1.5\n\n"
    "[matrix_family]\nM = [[[1]]]\nC = [[[\"p*p + q*q - 1\"]]]\nK = [[[\"0.8 - p - q\"]]]\n";

std::vector<Complex> circle_spectrum(double p, double q) {
  const double c = p * p + q * q - 1.0;
  const Complex root = std::sqrt(Complex(0.25 * c * c - (0.8 - p - q)));
  return {-0.5 * c + root, -0.5 * c - root};
}

class MapTolerances : public testing::TestWithParam<double> {};

TEST_P(MapTolerances, CellsAreThoseOfTheClosedForm) {
  const double tolerance = GetParam();
  const StabilityMap map =
      stability_map(map_setup(circle, {"q", -1.5, 1.5, 17, 61}, {{"tolerance", exact_text(tolerance)}}));
  for_cells(map, [&](const MapLine& line, std::size_t cell, double p) {
    SCOPED_TRACE("p " + exact_text(p) + " q " + exact_text(line.second));
    const auto spectrum = circle_spectrum(p, line.second);
    EXPECT_EQ(line.unstable[cell], growing(spectrum));
    // Near a meeting the tolerance holds for the block of both.
    const double size = std::max(std::abs(spectrum[0]), std::abs(spectrum[1]));
    const double gap = std::abs(spectrum[0] - spectrum[1]);
    const double bound = 10.0 * tolerance * std::max(size, 1.0) *
                         std::min(std::max(1.0, 1.0 / gap), 1.0 / std::sqrt(tolerance));
    EXPECT_NEAR(line.margin[cell], -fastest(spectrum), bound);
  });
}

INSTANTIATE_TEST_SUITE_P(All, MapTolerances, testing::Values(1e-4, 1e-6, 1e-9), [](const auto& test) {
  return "tolerance_1em" + std::to_string(static_cast<int>(-std::log10(test.param) + 0.5));
});

/// Cells exactly on the circle and on the line have the smaller number of growing modes of both sides.
TEST(StabilityMap, CellsOnABoundaryCountTheCalmerSide) {
  for (const auto& [from, to] : {std::pair("-1", "1"), std::pair("1", "-1")}) {
    SCOPED_TRACE(from);
    const StabilityMap map =
        stability_map(map_setup(circle, {"q", -0.6, 0.6, 3, 21}, {{"from", from}, {"to", to}}));
    const auto unstable = [&](std::size_t line, double p) {
      const auto at = std::min_element(map.first.begin(), map.first.end(),
                                       [p](double a, double b) { return std::abs(a - p) < std::abs(b - p); });
      return map.lines[line].unstable[static_cast<std::size_t>(at - map.first.begin())];
    };
    // q = -0.6: flutter at p = -0.8 and 0.8.
    EXPECT_EQ(unstable(0, -0.8), 0);
    EXPECT_EQ(unstable(0, -0.7), 1);
    EXPECT_EQ(unstable(0, 0.8), 0);
    // q = 0: flutter at -1 and 1; inside, two real roots at p = 0.8, one of which passes zero.
    EXPECT_EQ(unstable(1, -1.0), 0);
    EXPECT_EQ(unstable(1, 0.8), 1);
    EXPECT_EQ(unstable(1, 0.7), 1);
  }
}

/// s^2 + c s + 3 - p, twice: both pairs grow where c < 0, both real roots where p > 3. One of the equal parts
/// is traced, and cells count both.
TEST(StabilityMap, CellsCountTheModesOfAllEqualParts) {
  const StabilityMap map = stability_map(map_setup(R"(
parameters = { c = 0.1 }
trace = { parameter = "p", from = 0.5, to = 4 }
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[["c", 0], [0, "c"]]]
K = [[[3, 0], [0, 3]], [[-1, 0], [0, -1]]]
)",
                                                   {"c", -0.5, 0.5, 2, 8}));
  for_cells(map, [](const MapLine& line, std::size_t cell, double p) {
    if (p == 3.0 || (p > 3.0 && line.second < 0.0)) return;  // on the boundary; one root of two grows in each
    const bool grows = p > 3.0 || line.second < 0.0;
    EXPECT_EQ(line.unstable[cell], grows ? 2 : 0) << p;
    EXPECT_EQ(line.doubtful_cells, 0);
  });
}

/// K = [[1, q], [-q, 1 + d]] has real eigenvalues, all modes on the imaginary axis, where |d| >= 2 |q|.
TEST(StabilityMap, UndampedSystemsAreMarginalOutsideFlutter) {
  const std::string scene =
      "[parameters]\nd = 0.0\nq = 0.0\n\n[trace]\nparameter = \"d\"\nfrom = -0.9\nto = 2\n\n"
      "[matrix_family]\nM = [[[1, 0], [0, 1]]]\nK = [[[1, \"q\"], [\"-q\", \"1 + d\"]]]\n";
  const StabilityMap map = stability_map(map_setup(scene, {"q", -0.4, 0.4, 9, 59}));
  int marginal = 0;
  bool rival_is_fooled = false;  // QZ in every cell sees growth in rounding
  for_cells(map, [&](const MapLine& line, std::size_t cell, double d) {
    SCOPED_TRACE("d " + exact_text(d) + " q " + exact_text(line.second));
    constexpr double on_boundary = 1e-12;
    const bool flutter = std::abs(d) < 2.0 * std::abs(line.second) - on_boundary;
    EXPECT_EQ(line.unstable[cell], flutter ? 1 : 0);
    EXPECT_EQ(line.margin[cell] < 0.0, flutter);
    if (!flutter) {
      EXPECT_EQ(line.margin[cell], 0.0);
    }
    marginal += flutter ? 0 : 1;
    Matrix K(2, 2);
    K << 1, line.second, -line.second, 1 + d;
    const auto qz = quadratic_eigenvalues(Matrix::Identity(2, 2), Matrix::Zero(2, 2), K);
    rival_is_fooled = rival_is_fooled || (!flutter && growing(qz) > 0);
  });
  EXPECT_TRUE(rival_is_fooled);
  const MapTotals totals = total(map);
  EXPECT_EQ(totals.marginal, static_cast<std::size_t>(marginal));
  EXPECT_EQ(totals.stable, 0u);
  EXPECT_EQ(totals.marginal + totals.unstable, totals.cells);
}

/// All eigenvalues along a line by QZ; each equilibrium is found from the one before.
std::vector<std::vector<Complex>> qz_along(const MapSetup& setup, const std::vector<double>& first,
                                           double second) {
  PathProblem problem = problem_along(*setup.trace.model, setup.trace.options.parameter);
  problem.parameters[setup.trace.scene.parameters.index(setup.options.second).value()] = second;
  EquilibriumGuess guess{setup.trace.model->initial_guess(parameters_at(problem, first.front())), Vector()};
  RunCounts counts;
  std::vector<std::vector<Complex>> spectra;
  for (const double p : first) {
    const PathPoint point = reduce_at(problem, p, guess, Matrix(), counts);
    spectra.push_back(quadratic_eigenvalues(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]));
    guess = {point.equilibrium.x, point.equilibrium.lambda, true};
  }
  return spectra;
}

TEST(StabilityMap, RotatingMassIsThatOfQzInEveryCell) {
  const Setting setting = scene_setting("rotating_mass");
  const MapSetup setup = prepare_map(setting.scene, {}, {"drag", 0.5, 400.0, 8, 25});
  const StabilityMap map = stability_map(setup);
  double second = NAN;
  std::vector<std::vector<Complex>> spectra;
  for_cells(map, [&](const MapLine& line, std::size_t cell, double omega) {
    SCOPED_TRACE("omega " + exact_text(omega) + " drag " + exact_text(line.second));
    if (line.second != second) spectra = qz_along(setup, map.first, second = line.second);
    const std::vector<Complex>& spectrum = spectra[cell];
    EXPECT_EQ(line.unstable[cell], growing(spectrum));
    double largest = 0.0, least_ratio = INFINITY;
    for (const Complex s : spectrum) {
      largest = std::max(largest, std::abs(s));
      if (s.imag() != 0.0) least_ratio = std::min(least_ratio, -s.real() / std::abs(s));
    }
    const double bound = 10.0 * setup.trace.options.tolerance;
    EXPECT_NEAR(line.margin[cell], -fastest(spectrum), bound * largest);
    EXPECT_NEAR(line.damping_ratio[cell], least_ratio, bound);
  });
  const MapTotals totals = total(map);
  EXPECT_EQ(totals.unknown, 0u);
  EXPECT_GT(totals.unstable, 0u);
  EXPECT_GT(totals.stable, 0u);
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i]));
}

TEST(StabilityMap, HasTheSameBitsForAnyNumberOfThreads) {
  MapSetup setup = map_setup(circle, {"q", -1.5, 1.5, 9, 31});
  setup.options.jobs = 1;
  const StabilityMap expected = stability_map(setup);
  for (const int jobs : {0, 2, 3, 7, 40}) {
    SCOPED_TRACE(jobs);
    setup.options.jobs = jobs;
    int last = 0;
    const StabilityMap map = stability_map(setup, [&last](int lines) { EXPECT_EQ(lines, ++last); });
    EXPECT_EQ(last, 9);
    ASSERT_EQ(map.lines.size(), expected.lines.size());
    expect_same_bits(map.first, expected.first);
    for (std::size_t i = 0; i < map.lines.size(); ++i) {
      const MapLine& line = map.lines[i];
      EXPECT_EQ(line.second, expected.lines[i].second);
      EXPECT_EQ(line.unstable, expected.lines[i].unstable);
      EXPECT_EQ(line.factorizations(), expected.lines[i].factorizations());
      expect_same_bits(line.margin, expected.lines[i].margin);
      expect_same_bits(line.damping_ratio, expected.lines[i].damping_ratio);
      ASSERT_EQ(line.axis_points.size(), expected.lines[i].axis_points.size());
      for (std::size_t k = 0; k < line.axis_points.size(); ++k)
        expect_same_bits({line.axis_points[k].p}, {expected.lines[i].axis_points[k].p});
    }
  }
}

TEST(StabilityMap, HasTheAxisPointsOfTheBoundary) {
  const MapSetup setup = map_setup(circle, {"q", -0.6, 0.6, 2, 2});
  const MapLine line = map_line(setup, -0.6, {-1.5, 1.5});
  // c = 0 at p = -0.8 and 0.8, both with k > 0; k = 0 at p = 1.4.
  ASSERT_EQ(line.axis_points.size(), 3u);
  const std::vector<AxisPoint> expected = {
      {-0.8, "flutter", std::sqrt(2.2)}, {0.8, "flutter", std::sqrt(0.6)}, {1.4, "divergence", 0.0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(line.axis_points[i].p, expected[i].p, 1e-8);
    EXPECT_EQ(line.axis_points[i].kind, expected[i].kind);
    EXPECT_NEAR(line.axis_points[i].frequency, expected[i].frequency, 1e-6);
  }
}

/// A pendulum pushed sideways by p times its weight: upright equilibria end at p = 1.
const std::string pushed_pendulum =
    "[parameters]\ng = 9.81\np = 0.0\nr = 0.1\n\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 1.2\n\n"
    "[gravity]\nacceleration = [0, 0, \"-g\"]\n\n[[point]]\nname = \"bob\"\nmass = 1\nposition = [0, 0, "
    "-1]\n\n"
    "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = 1\n\n[[fixed]]\npoint = \"bob\"\ncoordinate = "
    "\"y\"\n\n"
    "[[follower_force]]\npoint = \"bob\"\nfrom = [0, 0, 0]\nto = \"bob\"\nmagnitude = \"p*g\"\n"
    "angle = \"-pi/2\"\naxis = [0, 1, 0]\n\n[[drag]]\npoint = \"bob\"\ncoefficient = \"r\"\n";

TEST(StabilityMap, CellsBeyondAFoldAreUnknown) {
  const StabilityMap map = stability_map(map_setup(pushed_pendulum, {"r", -0.1, 0.1, 3, 13}));
  for_cells(map, [&](const MapLine& line, std::size_t cell, double p) {
    SCOPED_TRACE("p " + exact_text(p) + " r " + exact_text(line.second));
    EXPECT_TRUE(line.turned_back);
    if (std::abs(p - 1.0) < 1e-9) return;
    EXPECT_EQ(line.unstable[cell], p > 1.0 ? MapLine::unknown : line.second < 0.0 ? 1 : 0);
    EXPECT_EQ(std::isnan(line.margin[cell]), p > 1.0);
    EXPECT_EQ(std::isnan(line.damping_ratio[cell]), p > 1.0);
  });
}

TEST(StabilityMap, LinesWithoutEquilibriumAreUnknown) {
  const StabilityMap map = stability_map(
      map_setup(pushed_pendulum, {"p", 0.0, 1.5, 4, 5}, {{"parameter", "r"}, {"from", "0.1"}, {"to", "1"}}));
  for (const MapLine& line : map.lines) {
    const bool exists = line.second < 1.0;
    EXPECT_EQ(line.status, exists ? TraceStatus::completed : TraceStatus::no_equilibrium) << line.second;
    EXPECT_EQ(line.message.empty(), exists);
    EXPECT_EQ(std::isnan(line.reached), !exists);
    EXPECT_EQ(line.unstable, std::vector<int>(5, exists ? 0 : MapLine::unknown));
  }
  EXPECT_EQ(total(map).unknown, 10u);
}

/// p s^2 + q s + 1 = 0: at p = 0 a second eigenvalue, -q/p, comes in from infinity. A trace that begins there
/// does not have it.
TEST(StabilityMap, CellsWithAMissingModeAreUnknown) {
  const std::string scene =
      "[parameters]\nq = -1.0\n\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 0.1\n\n"
      "[matrix_family]\nM = [[[0]], [[1]]]\nC = [[[\"q\"]]]\nK = [[[1]]]\n";
  const StabilityMap map = stability_map(map_setup(scene, {"q", -1.0, 1.0, 2, 11}));
  for (const MapLine& line : map.lines) EXPECT_GT(line.doubtful_cells, 0);
  for_cells(map, [&](const MapLine& line, std::size_t cell, double p) {
    SCOPED_TRACE("p " + exact_text(p) + " q " + exact_text(line.second));
    const int expected = line.second < 0.0 ? 2 : 0;
    if (line.unstable[cell] != MapLine::unknown) {
      EXPECT_EQ(line.unstable[cell], expected);
    }
  });
}

/// The option `modes` of the scene may leave some modes out. One that grows counts all the same.
TEST(StabilityMap, OfSomeModesIsThatOfTheWholeModel) {
  const std::string scene =
      "[parameters]\nb = 0.0\n\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\nmodes = 1\n\n"
      "[matrix_family]\nM = [[[1, 0], [0, 1]]]\nC = [[[\"b\", 0], [0, -0.1]]]\n"
      "K = [[[1, 0], [0, 4]], [[1, 0], [0, 1]]]\n";
  const MapLine line = map_line(map_setup(scene, {"b", 0.1, 0.2, 2, 2}), 0.1, {0.0, 0.5, 1.0});
  EXPECT_EQ(line.unstable, std::vector<int>(3, 1));
  EXPECT_EQ(line.partial_cells, 0);
  EXPECT_EQ(line.n_modes, 1);
  EXPECT_EQ(line.n_available, 2);
}

}  // namespace
}  // namespace eigentrail::test::stability_map_test
