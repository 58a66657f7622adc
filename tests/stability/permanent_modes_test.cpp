#include "eigentrail/stability/permanent_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "eigentrail/stability/stable_ranges.hpp"
#include "support/scenes.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test::permanent_modes_test {
namespace {

using test::make_setting;

struct Traced : TracedPath {
  EigenvalueAccuracy accuracy;
};

Traced traced(const std::string& text, const OptionTexts& options = {}) {
  const test::Setting setting = make_setting(text, options);
  Traced all{trace_path(*setting.model, setting.options), {}};
  all.accuracy = {setting.options.tolerance, all.result.s_ref};
  return all;
}

/// A free coordinate with damping (a zero and -0.5), a constant oscillator, and s^2 + 2 d s + 1 + p with
/// d = 0.1.
const std::string free_and_constant =
    "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\n"
    "M = [ [[1, 0, 0], [0, 1, 0], [0, 0, 1]] ]\n"
    "C = [ [[0.5, 0, 0], [0, 0.4, 0], [0, 0, 0.2]] ]\n"
    "K = [ [[0, 0, 0], [0, 9, 0], [0, 0, 1]], [[0, 0, 0], [0, 0, 0], [0, 0, 1]] ]\n";

TEST(PermanentModes, ZerosAndConstantsAreToldFromModesThatMove) {
  const Traced all = traced(free_and_constant);
  ASSERT_EQ(all.path.eigenvalues.cols(), 4);
  EXPECT_EQ(permanence_of_modes(all.path, all.accuracy),
            (std::vector<Permanence>{Permanence::zero, Permanence::constant, Permanence::none,
                                     Permanence::constant}));
}

TEST(PermanentModes, AZeroThroughoutDoesNotMakeTheRangeMarginal) {
  const Traced all = traced(free_and_constant);
  const auto ranges = stable_ranges(all.path, all.result.events, all.accuracy);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].kind, Stability::stable);
  EXPECT_NEAR(ranges[0].least_margin, 0.1, 1e-9);
}

TEST(PermanentModes, DoubleZerosOfAFreeBodyCountAsZero) {
  // Two masses on a spring in free flight, with relative damping: a double zero, defective, and one pair.
  const Traced all = traced(
      "[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n[matrix_family]\nM = [ [[1, 0], [0, 2]] ]\n"
      "C = [ [[0.1, -0.1], [-0.1, 0.1]] ]\nK = [ [[0, 0], [0, 0]], [[1, -1], [-1, 1]] ]\n");
  const auto permanence = permanence_of_modes(all.path, all.accuracy);
  // By rounding they are two real zeros or a pair, which is one mode.
  EXPECT_GE(std::count(permanence.begin(), permanence.end(), Permanence::zero), 1);
  EXPECT_EQ(permanence.back(), Permanence::none);
  const auto ranges = stable_ranges(all.path, all.result.events, all.accuracy);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].kind, Stability::stable);
}

TEST(PermanentModes, WhatPassesZeroIsNoPermanentZero) {
  const Traced all = traced(
      "[trace]\nparameter = \"p\"\nfrom = -1\nto = 1\n[matrix_family]\nM = [ [[1]] ]\nC = [ [[2]] ]\n"
      "K = [ [[0]], [[0.1]] ]\n");
  for (const Permanence permanence : permanence_of_modes(all.path, all.accuracy))
    EXPECT_EQ(permanence, Permanence::none);
  EXPECT_EQ(stable_ranges(all.path, all.result.events, all.accuracy).size(), 1u);
}

TEST(PermanentModes, NumbersOfModesDoNotCountZerosUnlessTheyAreFollowed) {
  const Traced listed = traced(free_and_constant, {{"modes", "2"}});
  EXPECT_NEAR(listed.path.eigenvalues(0, 0).real(), -0.5, 1e-12);
  ASSERT_FALSE(listed.result.notes.empty());
  EXPECT_NE(listed.result.notes[0].find("1 eigenvalue is zero for every p"), std::string::npos);
  const Traced followed = traced(free_and_constant, {{"modes", "2"}, {"constant_modes", "follow"}});
  EXPECT_EQ(followed.path.eigenvalues(0, 0), Complex(0.0));
}

}  // namespace
}  // namespace eigentrail::test::permanent_modes_test
