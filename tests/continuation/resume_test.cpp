// Interrupting and resuming traces with branches, planes and sparse matrices; states that are damaged or
// belong to another trace.
#include <gtest/gtest.h>

#include <random>

#include "eigentrail/core/errors.hpp"
#include "scene/input_error.hpp"
#include "support/resumed.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::resume_test {
namespace {

std::string difference(const Setting& setting, std::size_t states = 8) {
  return first_resumed_difference(*setting.model, setting.options, states);
}

TEST(Resume, SceneOfEveryKindIsTheSameBitForBit) {
  for (const char* name : {"rotating_mass", "beck_column", "ground_resonance", "four_bar", "overhung_disc",
                           "sleeping_top", "flap_lag", "whirling_pendulum", "spring_pendulum"}) {
    EXPECT_EQ(difference(scene_setting(name)), "") << name;
  }
}

TEST(Resume, FewOfManyModesAreTheSame) {
  EXPECT_EQ(difference(scene_setting("princeton_blade", {{"modes", "2"}})), "");
}

TEST(Resume, PathThatTurnsBackIsTheSame) {
  const Setting setting = pushed_pendulum({}, {{"tolerance", "1e-6"}, {"to", "-0.5"}});
  EXPECT_EQ(difference(setting, 40), "");
}

TEST(Resume, OtherPathAtABranchPointIsTheSame) {
  for (const char* branch : {"1", "2", "3"}) {
    EXPECT_EQ(difference(scene_setting("watt_governor", {{"branch", branch}, {"to", "60"}}), 40), "")
        << branch;
  }
}

TEST(Resume, TraceWithoutCertificateIsTheSame) {
  EXPECT_EQ(difference(scene_setting("rotating_mass", {{"certify", "false"}, {"order", "1"}})), "");
}

class DamagedState : public testing::Test {
 protected:
  const Setting setting = scene_setting("rotating_mass", {{"tolerance", "1e-4"}});
  const SavedRun run = run_and_save(*setting.model, setting.options);
  const std::string state = run.states.at(run.states.size() / 2);

  void expect_refused(const std::string& bytes, const std::string& what) {
    const std::string message = input_error([&] { run_from(*setting.model, setting.options, bytes); });
    EXPECT_TRUE(contains(message, "the state of the trace")) << what << ": " << message;
  }
};

TEST_F(DamagedState, ThatEndsEarlyOrGoesOnIsRefused) {
  for (std::size_t size = 0; size < state.size(); size += 1 + state.size() / 200)
    expect_refused(state.substr(0, size), "a state of " + std::to_string(size) + " bytes");
  expect_refused(state + 'x', "a state with a byte too many");
}

TEST_F(DamagedState, WithWrongBytesIsRefused) {
  std::mt19937 random(20);
  for (int i = 0; i < 400; ++i) {
    std::string bytes = state;
    for (int j = 0; j < 3; ++j) ++bytes[random() % bytes.size()];
    expect_refused(bytes, "a state with three wrong bytes");
  }
}

TEST_F(DamagedState, OfAnotherModelIsRefused) {
  const Setting pendulum = scene_setting("pendulum");
  EXPECT_THROW(static_cast<void>(run_from(*pendulum.model, pendulum.options, state)), InputError);
  const Setting heavier =
      scene_setting("rotating_mass", {{"tolerance", "1e-4"}}, {{"value = 50.0", "value = 50.1"}});
  const std::string message = input_error([&] { run_from(*heavier.model, heavier.options, state); });
  EXPECT_TRUE(contains(message, "other matrices at omega = ")) << message;
}

}  // namespace
}  // namespace eigentrail::test::resume_test
