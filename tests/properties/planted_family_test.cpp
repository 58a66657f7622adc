// Consistency of the planted families: the data that the sweep takes as exact are checked by other methods.
#include "properties/planted_family.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "hard_cases/clear_parameters.hpp"
#include "hard_cases/special_point_check.hpp"
#include "properties/run_family.hpp"
#include "support/seeds.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::planted_family_test {
namespace {

class PlantedFamilies : public testing::TestWithParam<int> {
 protected:
  PlantedFamily family_ = planted_family(static_cast<std::uint64_t>(GetParam()));
  HardCase case_ = family_.as_case();
};

Matrix at(const MatrixSeries& series, double p) {
  Matrix value = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) value = value * p + series[k];
  return value;
}

TEST_P(PlantedFamilies, HaveTheSpectrumOfTheirMatrices) {
  double scale = largest_at_start(case_);
  for (const double p : clear_parameters(case_)) {
    const std::vector<Complex> exact = family_.spectrum(p);
    // Every closed form makes the mixed pencil singular, and none is missing: the sum is -tr M^-1 C.
    const WidePencil pencil = case_.pencil(p, 0);
    WideComplex sum = (pencil.M.inverse() * pencil.C).trace();
    for (const Complex s : exact) {
      EXPECT_LT(Singularity(pencil, s, scale).values[0], 1e-14) << "s = " << s << " at " << p;
      sum += s;
    }
    ASSERT_EQ(static_cast<Eigen::Index>(exact.size()), 2 * family_.size());
    EXPECT_LT(std::abs(sum), 1e-13L * scale) << "at " << p;
    // LAPACK sees the same: to the digits that a mode 1e-3 of the range beside a defective one leaves.
    const Family& m = family_.matrices;
    EXPECT_LT(matched_distance(quadratic_eigenvalues(at(m.M, p), at(m.C, p), at(m.K, p)), exact), 1e-8)
        << "at " << p;
  }
}

TEST_P(PlantedFamilies, HaveGenuineSpecialPoints) {
  for (const SpecialPoint& point : case_.special) {
    SCOPED_TRACE(point.kind + " at " + std::to_string(point.parameter));
    EXPECT_GE(point.s.imag(), 0.0);
    SpecialPointCheck(case_).check(point);
  }
}

/// What a scan of the real range sees of the exact modes, without any polynomial.
class Scan {
 public:
  explicit Scan(const PlantedFamily& family) : family_(family) {
    constexpr int n = 25000;  // finer than half of the least distance of special points
    std::vector<LabelledMode> last;
    for (int i = 0; i <= n; ++i) {
      const double p = family.from + (family.to - family.from) * (i + 0.31) / (n + 0.62);
      std::vector<LabelledMode> now = family.labelled(p);
      if (i > 0) compare(last, now, p);
      last = std::move(now);
      last_p_ = p;
    }
  }

  /// Sign changes of Re s; of the distance of two modes that vanishes there; of the number of real modes or
  /// of the sign of the imaginary part of mu.
  int stability = 0, crossings = 0, collisions = 0;

 private:
  static Complex mu_like(const LabelledMode& mode, const PlantedBlock& block, double p) {
    const Complex c = static_cast<double>(block.damping(static_cast<Wide>(p)));
    return -mode.s * mode.s - 2.0 * c * mode.s;
  }

  const PlantedBlock& block_of(const LabelledMode& mode) const {
    return family_.blocks[static_cast<std::size_t>(mode.family)];
  }

  /// Eigenvalues of a block of two are complex, or those of one freedom real.
  bool beyond_collision(const LabelledMode& mode, double p) const {
    if (block_of(mode).size == 1) return mode.s.imag() == 0.0;
    return std::abs(mu_like(mode, block_of(mode), p).imag()) > 1e-9;
  }

  void compare(const std::vector<LabelledMode>& last, const std::vector<LabelledMode>& now, double p) {
    for (const LabelledMode& a : last) {
      for (const LabelledMode& b : now) {
        if (a.family != b.family || a.label != b.label) continue;
        // The first mode of a block tells for both.
        if (a.label == 0 && beyond_collision(a, last_p_) != beyond_collision(b, p)) ++collisions;
        if (a.version == b.version && (a.s.real() < 0.0) != (b.s.real() < 0.0)) ++stability;
      }
    }
    if (last.size() != now.size()) return;
    for (std::size_t i = 0; i < now.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (now[i].family == now[j].family || !same_sign_change(last, now, i, j)) continue;
        crossings += meet(now[i], now[j], p);
      }
    }
  }

  static bool same_sign_change(const std::vector<LabelledMode>& last, const std::vector<LabelledMode>& now,
                               std::size_t i, std::size_t j) {
    const Complex before = last[i].s - last[j].s;
    const Complex after = now[i].s - now[j].s;
    const bool real = now[i].s.imag() == 0.0 && now[j].s.imag() == 0.0;
    return real ? (before.real() < 0.0) != (after.real() < 0.0)
                : (before.imag() < 0.0) != (after.imag() < 0.0);
  }

  Complex value(const LabelledMode& mode, double p) const {
    for (const LabelledMode& other : family_.labelled(p)) {
      if (other.family == mode.family && other.label == mode.label) return other.s;
    }
    return NAN;
  }

  /// Whether the modes coincide where their difference changes its sign before p: by bisection.
  bool meet(const LabelledMode& a, const LabelledMode& b, double p) const {
    double left = last_p_;
    double right = p;
    const bool real = a.s.imag() == 0.0 && b.s.imag() == 0.0;
    const auto negative = [&](double at) {
      const Complex difference = value(a, at) - value(b, at);
      return (real ? difference.real() : difference.imag()) < 0.0;
    };
    const bool at_left = negative(left);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (left + right);
      (negative(middle) == at_left ? left : right) = middle;
    }
    return std::abs(value(a, left) - value(b, left)) < 1e-12;
  }

  const PlantedFamily& family_;
  double last_p_ = 0.0;
};

TEST_P(PlantedFamilies, HaveNoOtherSpecialPoints) {
  const Scan scan(family_);
  const auto number_of = [&](const std::set<std::string>& kinds) {
    return std::count_if(case_.special.begin(), case_.special.end(),
                         [&](const SpecialPoint& point) { return kinds.count(point.kind) > 0; });
  };
  EXPECT_EQ(scan.stability, number_of({"flutter", "divergence"}));
  EXPECT_EQ(scan.crossings, number_of({"crossing"}));
  EXPECT_EQ(scan.collisions, number_of({"collision"}));
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlantedFamilies, first_seeds(30), seed_name);

TEST(PlantedFamily, CoversEveryKindAndSize) {
  std::map<std::string, int> kinds;
  std::set<Eigen::Index> sizes;
  std::set<std::string> mixings;
  double narrowest = 1.0;
  double closest = 1.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const PlantedFamily family = planted_family(seed);
    sizes.insert(family.size());
    mixings.insert(family.mixing);
    for (std::size_t i = 0; i < family.special.size(); ++i) {
      ++kinds[family.special[i].kind];
      if (family.special[i].kind == "veering") narrowest = std::min(narrowest, family.special[i].half_width);
      if (i > 0) {
        const double distance = family.special[i].parameter - family.special[i - 1].parameter;
        if (distance > 0.0) closest = std::min(closest, distance);
      }
    }
  }
  for (const char* kind : {"veering", "crossing", "collision", "flutter", "divergence"})
    EXPECT_GE(kinds[kind], 20) << kind;
  EXPECT_EQ(sizes.size(), 10U);
  EXPECT_EQ(mixings.size(), 4U);
  EXPECT_LT(narrowest, 1e-8);
  EXPECT_LT(closest, 2e-4);
}

TEST(PlantedFamily, IsTheSameForTheSameSeed) {
  EXPECT_EQ(planted_family(7).as_case().scene, planted_family(7).as_case().scene);
  EXPECT_NE(planted_family(7).as_case().scene, planted_family(8).as_case().scene);
}

TEST(Mixing, RefusesCoefficientsThatRoundingWouldChange) {
  PlantedBlock block;
  block.damping = Polynomial(0.1L);  // not a double
  block.stiffness = {Polynomial(4)};
  EXPECT_THROW((void)mixed({block}, {Matrix::Ones(1, 1)}, {Matrix::Ones(1, 1)}), UnusableFamily);
}

// The checks of the sweep must be able to fail.

/// Two modes that cross once at p = 0.1, s = +-j sqrt(4 + p - 0.1) and +-2j, damped a little.
PlantedFamily one_crossing() {
  PlantedFamily family;
  family.from = -0.5;
  family.to = 0.5;
  const Polynomial c(0.0625);
  family.blocks = {{"flat", 1, c, {Polynomial(4)}, {}},
                   {"steep", 1, c, {Polynomial(4) + from_root(0.125)}, {}}};
  find_special_points(family);
  Matrix T(2, 2);
  T << 1, 0.5, -0.25, 1;
  family.matrices = mixed(family.blocks, {T}, {T});
  return family;
}

TEST(RunFamily, PassesASingleCrossing) {
  const PlantedFamily family = one_crossing();
  ASSERT_EQ(family.special.size(), 1U);
  EXPECT_EQ(family.special[0].parameter, 0.125);
  EXPECT_EQ(run_family(family, {}).problems(), "");
}

TEST(RunFamily, NoticesEventsThatAreMissingOrInvented) {
  PlantedFamily family = one_crossing();
  family.special[0].parameter += 1e-6;
  const FamilyReport report = run_family(family, {});
  EXPECT_EQ(report.events.missing.size(), 1U);
  EXPECT_EQ(report.events.invented.size(), 1U);
  EXPECT_NE(report.problems(), "");
}

TEST(RunFamily, NoticesAValueThatIsOff) {
  PlantedFamily family = one_crossing();
  family.blocks[0].stiffness = {Polynomial(Wide(4.0001))};
  EXPECT_GT(run_family(family, {}).accuracy.worst_error, 4.0);
}

TEST(RunFamily, NoticesLabelsThatAreExchanged) {
  // With a coupling that makes it a veering of half-width 1e-9, each mode keeps its side. If the veering is
  // taken for a crossing, the labels are wrong.
  PlantedFamily family = one_crossing();
  PlantedFamily veering = family;
  veering.blocks = {{"veering", 2, family.blocks[0].damping, {}, {}}};
  const Polynomial coupling(0x1p-30L);
  veering.blocks[0].stiffness = {Polynomial(4), coupling, coupling, Polynomial(4) + from_root(0.125)};
  Matrix T(2, 2);
  T << 1, 0.5, -0.25, 1;
  family.matrices = mixed(veering.blocks, {T}, {T});
  const FamilyReport report = run_family(family, {});
  EXPECT_GT(report.labels.wrong, 0);
  EXPECT_NE(report.problems(), "");
}

}  // namespace
}  // namespace eigentrail::test::planted_family_test
