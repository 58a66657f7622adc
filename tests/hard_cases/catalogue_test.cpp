// Consistency of the catalogue: closed forms agree with the pencils, and every special point satisfies the
// conditions of its kind.
#include "hard_cases/catalogue.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "hard_cases/clear_parameters.hpp"
#include "hard_cases/special_point_check.hpp"
#include "paper/rotating_mass_reference.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::catalogue_test {
namespace {

class HardCases : public testing::TestWithParam<HardCase> {
 protected:
  const HardCase& hard_case() const { return GetParam(); }
};

TEST_P(HardCases, SpectrumMakesThePencilSingularAndAddsUp) {
  const double scale = largest_at_start(hard_case());
  for (const double p : clear_parameters(hard_case())) {
    const auto spectra = hard_case().spectrum(p);
    for (std::size_t branch = 0; branch < spectra.size(); ++branch) {
      if (spectra[branch].empty()) continue;
      const WidePencil pencil = hard_case().pencil(p, static_cast<int>(branch));
      ASSERT_EQ(static_cast<Eigen::Index>(spectra[branch].size()), 2 * pencil.M.rows());
      const WideComplexMatrix inverse = pencil.M.inverse();
      WideComplex sum = (inverse * pencil.C).trace();
      double total = 0.0;
      for (const Complex s : spectra[branch]) {
        EXPECT_LT(Singularity(pencil, s, scale).values[0], 1e-14) << "s = " << s << " at " << p;
        sum += s;
        total += std::abs(s);
      }
      // The sum of all eigenvalues is -tr(M^-1 C): none is missing or there twice.
      EXPECT_LT(std::abs(sum), 1e-14 * total) << "at " << p;
    }
  }
}

TEST_P(HardCases, SpecialPointsAreGenuine) {
  const auto [low, high] = std::minmax(hard_case().from, hard_case().to);
  for (const SpecialPoint& point : hard_case().special) {
    SCOPED_TRACE(point.kind + " at " + std::to_string(point.parameter));
    EXPECT_GE(point.parameter, low);
    EXPECT_LE(point.parameter, high);
    EXPECT_GE(point.s.imag(), 0.0);
    SpecialPointCheck(hard_case()).check(point);
  }
}

/// Number of eigenvalues that are unstable by more than the rounding of an undamped pair; nothing where the
/// branch has no equilibrium.
std::optional<int> clearly_unstable(const HardCase& hard_case, double p, int branch) {
  const auto spectrum = hard_case.spectrum(p)[static_cast<std::size_t>(branch)];
  if (spectrum.empty()) return std::nullopt;
  double scale = 0.0;
  for (const Complex s : spectrum) scale = std::max(scale, std::abs(s));
  return static_cast<int>(
      std::count_if(spectrum.begin(), spectrum.end(), [&](Complex s) { return s.real() > 1e-12 * scale; }));
}

bool has_real_special_point_between(const HardCase& hard_case, double a, double b) {
  return std::any_of(hard_case.special.begin(), hard_case.special.end(), [&](const SpecialPoint& point) {
    return point.kind != "veering" && (point.parameter - a) * (point.parameter - b) <= 0.0;
  });
}

TEST_P(HardCases, StabilityChangesOnlyAtSpecialPoints) {
  constexpr int n_grid = 400;
  const auto n_branches = static_cast<int>(hard_case().spectrum(hard_case().from).size());
  for (int branch = 0; branch < n_branches; ++branch) {
    std::optional<int> last;
    double last_p = hard_case().from;
    for (int k = 0; k <= n_grid; ++k) {
      const double p = parameter_at(hard_case(), (k + 0.37) / (n_grid + 1));
      const auto count = is_clear(hard_case(), p) ? clearly_unstable(hard_case(), p, branch) : std::nullopt;
      if (!count) continue;
      if (last && !has_real_special_point_between(hard_case(), last_p, p)) {
        EXPECT_EQ(*count, *last) << "between " << last_p << " and " << p;
      }
      last = count;
      last_p = p;
    }
  }
}

TEST_P(HardCases, BranchesAreTheSpectrum) {
  EXPECT_EQ(hard_case().has_branches, !hard_case().branches.empty());
  if (!hard_case().has_branches) return;
  for (const double p : clear_parameters(hard_case())) {
    std::vector<Complex> members;
    for (const auto& branch : hard_case().branches) {
      members.push_back(branch(p));
      if (members.back().imag() != 0.0) members.push_back(std::conj(members.back()));
    }
    EXPECT_LT(matched_distance(members, hard_case().spectrum(p)[0]), 1e-14) << "at " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, testing::ValuesIn(hard_cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Catalogue, NamesAreUniqueAndCasesCanBeFound) {
  std::set<std::string> names;
  for (const HardCase& c : hard_cases()) names.insert(c.name);
  EXPECT_EQ(names.size(), hard_cases().size());
  EXPECT_EQ(hard_case("H02_crossing").name, "H02_crossing");
  EXPECT_THROW((void)hard_case("H00"), std::out_of_range);
}

TEST(Catalogue, RotatingMassAgreesWithThePapersReference) {
  const HardCase& c = hard_case("C01_rotating_mass");
  for (const RotatingMassReference& reference : rotating_mass_r2) {
    EXPECT_LT(relative_distance(reference.derivative(0), c.spectrum(reference.omega)[0]), 1e-15)
        << "omega = " << reference.omega;
  }
}

TEST(Catalogue, BladesAgreeWithTheirReferenceAtTheEnd) {
  // -s^2 of the undamped blades at p = 0.2, 40-digit arithmetic; damping 0.01 I only shifts s^2 + 0.01 s.
  const double mu[] = {0.930824258362119018, 0.969370495732038528, 1.0064198170572897,  1.06683950435423673,
                       1.16816275091584456,  1.21163103317621259,  1.24988480037792987, 1.29105205959703132};
  std::vector<Complex> found = hard_case("H21_eight_blades").spectrum(0.2)[0];
  std::vector<Complex> expected;
  for (const double value : mu) {
    for (const double sign : {1.0, -1.0}) expected.emplace_back(-0.005, sign * std::sqrt(value - 2.5e-5));
  }
  EXPECT_LT(matched_distance(expected, found), 1e-14);
}

/// The Jacobi method keeps the relative accuracy of the small eigenvalues of a graded matrix. Reduction to
/// tridiagonal form and QR would lose them.
TEST(WidePencil, JacobiKeepsTheSmallEigenvaluesOfAGradedMatrix) {
  const WideMatrix K = hard_case("graded_veering").pencil(0.0, 0).K.real();
  const std::vector<Wide> mu = jacobi_eigenvalues(K);
  Wide product = 1;
  for (const Wide value : mu) product *= value;
  // The determinant is a sum of few terms of one size: exact to rounding.
  const Wide determinant =
      K(0, 0) * (K(1, 1) * (K(2, 2) * K(3, 3) - K(2, 3) * K(2, 3)) - K(1, 2) * K(1, 2) * K(3, 3)) -
      K(0, 1) * K(0, 1) * (K(2, 2) * K(3, 3) - K(2, 3) * K(2, 3));
  EXPECT_LT(std::abs(product / determinant - 1), 1e-17);
}

}  // namespace
}  // namespace eigentrail::test::catalogue_test
