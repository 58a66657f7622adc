// Crossings of modes of independent parts, each with one freedom, on traces: places and derivatives in closed
// form.
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/core/text.hpp"
#include "support/matrix_text.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::part_crossings_test {
namespace {

constexpr Complex j{0.0, 1.0};

/// s^2 + c_i s + (w_i + v_i p)^2, in their own coordinates or, with an orthogonal `turn`, in others.
struct Oscillator {
  double c, w, v;
};

Setting oscillators(const std::vector<Oscillator>& all, double from, double to,
                    const OptionTexts& options = {}, const Matrix& turn = {}) {
  const auto matrix = [&](const auto& entry) {
    Vector diagonal(static_cast<Eigen::Index>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) diagonal[static_cast<Eigen::Index>(i)] = entry(all[i]);
    const Matrix A = diagonal.asDiagonal();
    return turn.size() > 0 ? Matrix(turn.transpose() * A * turn) : A;
  };
  return make_setting(family_scene({{matrix([](const Oscillator&) { return 1.0; })},
                                    {matrix([](const Oscillator& o) { return o.c; })},
                                    {matrix([](const Oscillator& o) { return o.w * o.w; }),
                                     matrix([](const Oscillator& o) { return 2.0 * o.w * o.v; }),
                                     matrix([](const Oscillator& o) { return o.v * o.v; })}},
                                   from, to),
                      options);
}

std::vector<Event> crossings_of(const Setting& setting) {
  const RecordedTrace trace = completed_trace(setting);
  for (const Event& event : trace.result.events) EXPECT_EQ(event.kind, EventKind::crossing);
  return trace.result.events;
}

TEST(CrossingsOfParts, HavePlaceModesAndEigenvalueInBothDirections) {
  const std::vector<Oscillator> all{{0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}, {0.0, 5.0, 0.5}};
  for (const bool backward : {false, true}) {
    const Setting setting = backward ? oscillators(all, 0.45, 0.05) : oscillators(all, 0.05, 0.45);
    const std::vector<Event> found = crossings_of(setting);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].p, 0.3, 1e-12);
    EXPECT_LT(std::abs(found[0].s - 2.3 * j), 1e-12);
    EXPECT_EQ(found[0].modes, (std::vector<int>{0, 1}));
    // The mean of both does not change.
    EXPECT_LT(std::abs(found[0].sensitivity[setting.traced()]), 1e-10);
  }
}

/// A place at the end of a step belongs to one of two steps; one behind the range to none.
TEST(CrossingsOfParts, AtEndsOfStepsAreFoundOnceAndOnlyOnTheRange) {
  for (const double beside : {0.0, 1e-6, -1e-6}) {
    const std::string length = exact_text(0.3 + beside);
    EXPECT_EQ(crossings_of(oscillators({{0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}}, 0.0, 0.9,
                                       {{"first_step", length}, {"max_step", length}}))
                  .size(),
              1U)
        << beside;
    // The range ends at 1, and the crossing lies half as far beside it.
    const std::size_t expected = beside > 0.0 ? 0 : 1;
    EXPECT_EQ(crossings_of(oscillators({{0.0, 2.0, 1.0}, {0.0, 4.0 + beside, -1.0}}, 0.8, 1.0)).size(),
              expected)
        << beside;
  }
}

/// Equal parts coincide throughout, which is no crossing, also where their eigenvalues differ by rounding. A
/// third mode crosses both at once.
TEST(CrossingsOfParts, OfEqualPartsAreOneWithAThird) {
  const Matrix turn{{2.0 / 3.0, -2.0 / 3.0, 1.0 / 3.0},
                    {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0},
                    {2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0}};
  for (const Matrix& coordinates : {Matrix(), turn}) {
    const std::vector<Event> found = crossings_of(
        oscillators({{0.0, 2.0, 1.0}, {0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}}, -1.0, 1.0, {}, coordinates));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].p, 0.3, 1e-12);
    EXPECT_EQ(found[0].modes, (std::vector<int>{0, 1, 2}));
  }
}

/// Im s agrees at one place, Re s does not: they pass beside each other.
TEST(CrossingsOfParts, NeedBothComponentsToAgree) {
  for (const double c : {0.2, 1e-3})
    EXPECT_TRUE(crossings_of(oscillators({{c, 2.0, 1.0}, {0.0, 2.6, -1.0}}, 0.0, 0.5)).empty()) << c;
  const std::vector<Event> found = crossings_of(oscillators({{0.2, 2.0, 1.0}, {0.2, 2.6, -1.0}}, 0.0, 0.5));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].p, 0.3, 1e-12);
  EXPECT_NEAR(found[0].s.real(), -0.1, 1e-12);
}

/// s^2 + 4 s + (1 + p)^2 and s^2 + 6 s + 1.5^2: the slower real modes cross where
/// (1 + p)^2 = 4 a - a^2, with -a the slower root of the other.
TEST(CrossingsOfParts, OfRealModesToo) {
  const double a = 3.0 - std::sqrt(9.0 - 2.25);
  const double p = std::sqrt(4.0 * a - a * a) - 1.0;
  const std::vector<Event> found =
      crossings_of(oscillators({{4.0, 1.0, 1.0}, {6.0, 1.5, 0.0}}, p - 0.1, p + 0.15));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].p, p, 1e-11);
  EXPECT_LT(std::abs(found[0].s + a), 1e-11);
}

/// Two masses on springs, p and q: they cross at p / m = q / n. Its place moves with q by m / n.
TEST(CrossingsOfParts, KnowHowTheirPlaceMoves) {
  const Setting setting = make_setting(
      "[parameters]\np = 5.0\nq = 6.0\nm = 2.0\nn = 3.0\n[trace]\nparameter = \"p\"\nfrom = 3\n"
      "to = 5\n[matrix_family]\nM = [[[\"m\", 0], [0, \"n\"]]]\n"
      "K = [[[0, 0], [0, \"q\"]], [[1, 0], [0, 0]]]\n");
  const std::vector<Event> found = crossings_of(setting);
  ASSERT_EQ(found.size(), 1U);
  const Event& event = found[0];
  EXPECT_NEAR(event.p, 4.0, 1e-10);
  EXPECT_NEAR(event.shift[setting.parameter("q")], 2.0 / 3.0, 1e-8);
  EXPECT_NEAR(event.shift[setting.parameter("m")], 2.0, 1e-8);
  EXPECT_NEAR(event.shift[setting.parameter("n")], -4.0 / 3.0, 1e-8);
  // Half of ds/dq = j / (2 sqrt(q n)): only one of the two moves.
  EXPECT_LT(std::abs(event.sensitivity[setting.parameter("q")] - 0.25 / std::sqrt(18.0) * j), 1e-9);
}

}  // namespace
}  // namespace eigentrail::test::part_crossings_test
