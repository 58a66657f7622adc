// The spectrum of each scene after the library's reduction, compared with the spectrum of the catalogue.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <optional>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "hard_cases/catalogue.hpp"
#include "hard_cases/clear_parameters.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::scenes_test {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

class Scenes : public testing::TestWithParam<HardCase> {
 protected:
  const HardCase& hard_case() const { return GetParam(); }
};

/// Allowed error of QZ for an eigenvalue s of the companion pencil (A, E): its backward error times the
/// condition number (|A| + |s| |E|) |X| |Y| / |Y^H E X|, X = (z, s z), Y = ((s M + C)^H y, y).
double qz_error(const ReducedPencil& pencil, Complex s) {
  const ComplexMatrix M = pencil.M[0].cast<Complex>();
  const ComplexMatrix C = pencil.C[0].cast<Complex>();
  const ComplexMatrix K = pencil.K[0].cast<Complex>();
  const Eigen::JacobiSVD<ComplexMatrix> svd(ComplexMatrix(s * s * M + s * C + K),
                                            Eigen::ComputeFullU | Eigen::ComputeFullV);
  const ComplexVector z = svd.matrixV().rightCols(1);
  const ComplexVector y = svd.matrixU().rightCols(1);
  const double x_norm = std::hypot(1.0, std::abs(s));
  const double y_norm = std::hypot(((s * M + C).adjoint() * y).norm(), 1.0);
  const double n = std::sqrt(static_cast<double>(M.rows()));
  const double norms = n + K.norm() + C.norm() + std::abs(s) * (n + M.norm());
  const double slope = std::abs(y.dot((2.0 * s * M + C) * z));
  return 10.0 * rounding * norms * x_norm * y_norm / slope;
}

/// Largest miss of QZ over what it may miss, the eigenvalues matched by taking the closest pair again and
/// again. The allowance ends at 1e-6 of the largest eigenvalue: a defective one has an infinite condition
/// number.
double worst_miss(const ReducedPencil& pencil, const std::vector<Complex>& expected) {
  std::vector<Complex> found = quadratic_eigenvalues(pencil.M[0], pencil.C[0], pencil.K[0]);
  if (found.size() != expected.size()) return INFINITY;
  double scale = 0.0;
  for (const Complex s : expected) scale = std::max(scale, std::abs(s));
  double worst = 0.0;
  std::vector<Complex> left = expected;
  while (!left.empty()) {
    double best = INFINITY;
    std::pair<std::size_t, std::size_t> closest;
    for (std::size_t i = 0; i < left.size(); ++i) {
      for (std::size_t j = 0; j < found.size(); ++j) {
        if (std::abs(left[i] - found[j]) < best) {
          best = std::abs(left[i] - found[j]);
          closest = {i, j};
        }
      }
    }
    worst = std::max(worst, best / std::min(qz_error(pencil, left[closest.first]), 1e-6 * scale));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(closest.first));
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(closest.second));
  }
  return worst;
}

/// The equilibrium solved along the range in steps of at most a hundredth.
class Walk {
 public:
  explicit Walk(const HardCase& hard_case)
      : case_(hard_case),
        setup_(prepare_trace(parse_scene(hard_case.scene, hard_case.name + ".toml"), {})),
        problem_(problem_along(*setup_.model, setup_.options.parameter)),
        guess_{setup_.model->initial_guess(parameters_at(problem_, hard_case.from)), {}},
        p_(hard_case.from) {}

  const TraceOptions& options() const { return setup_.options; }

  /// Nothing where the library finds no equilibrium.
  std::optional<ReducedPencil> to(double target) {
    const int steps = 1 + static_cast<int>(100.0 * std::abs((target - p_) / (case_.to - case_.from)));
    const double start = p_;
    for (int k = 1; k <= steps; ++k) {
      const double p = k == steps ? target : start + (target - start) * k / steps;
      const PathPoint point = reduce_at(problem_, p, guess_, Matrix(), counts_);
      if (point.status != PointStatus::computed) continue;  // the next one is tried from the same guess
      guess_ = {point.equilibrium.x, point.equilibrium.lambda, true};
      p_ = p;
      if (k == steps) return point.pencil;
    }
    return std::nullopt;
  }

 private:
  const HardCase& case_;
  TraceSetup setup_;
  PathProblem problem_;
  EquilibriumGuess guess_;
  double p_;
  RunCounts counts_;
};

TEST_P(Scenes, HaveTheRangeAndTheSpectrumByQz) {
  Walk walk(hard_case());
  const double margin = 4.0 * rounding * (std::abs(hard_case().from) + std::abs(hard_case().to));
  EXPECT_NEAR(walk.options().from, hard_case().from, margin);
  EXPECT_NEAR(walk.options().to, hard_case().to, margin);
  int compared = 0;
  for (const double p : clear_parameters(hard_case())) {
    const auto spectra = hard_case().spectrum(p);
    if (spectra[0].empty())
      continue;  // the path has turned back before: only a trace gets to the other branches
    const auto pencil = walk.to(p);
    ASSERT_TRUE(pencil.has_value()) << "no equilibrium at " << p;
    EXPECT_LT(worst_miss(*pencil, spectra[0]), 1.0) << "at " << p;
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

/// Branches that a scene's own guess does not lead to.
struct OtherBranch {
  std::string name;
  double p;
  int branch;
  std::vector<double> guess;
};

class OtherBranches : public testing::TestWithParam<OtherBranch> {};

TEST_P(OtherBranches, HaveTheSpectrumByQz) {
  const auto& [name, p, branch, near] = GetParam();
  const HardCase& c = hard_case(name);
  const TraceSetup setup = prepare_trace(parse_scene(c.scene, name + ".toml"), {});
  const PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  RunCounts counts;
  const Vector guess = Eigen::Map<const Vector>(near.data(), static_cast<Eigen::Index>(near.size()));
  const PathPoint point = reduce_at(problem, p, {guess, Vector()}, Matrix(), counts);
  ASSERT_EQ(point.status, PointStatus::computed) << point.message;
  EXPECT_LT(worst_miss(point.pencil, c.spectrum(p)[static_cast<std::size_t>(branch)]), 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Catalogue, OtherBranches,
    testing::Values(OtherBranch{"C03_fold_in_tangential_force", -15000, 1, {-0.74, -4.69, -0.02}},
                    OtherBranch{"C03_fold_in_tangential_force", -100, 1, {-4.0, -0.03, -0.08}},
                    OtherBranch{"C04_spring_pendulum_beyond_pitchfork", 8.0, 1, {0, 0, -1.5}},
                    OtherBranch{"C04_spring_pendulum_beyond_pitchfork", 20.0, 1, {0, 0, -1.5}},
                    OtherBranch{"C05_pushed_pendulum", 0.6, 1, {0.6, 0, 0.8}},
                    OtherBranch{"C06_von_mises_truss", 0.001, 1, {0, 0, 0.01}},
                    OtherBranch{"C06_von_mises_truss", 0.001, 2, {0, 0, -0.2}},
                    OtherBranch{"C06_von_mises_truss", 0.004, 2, {0, 0, -0.2}}),
    [](const auto& tested) { return tested.param.name.substr(0, 3) + "_" + std::to_string(tested.index); });

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(hard_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test::scenes_test
