// What the descriptions of OpenFAST's states say.
#include "import/openfast_states.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::openfast_states_test {
namespace {

struct Description {
  const char* text;
  const char* motion;
  const char* unit;
  int blade;
  bool is_rate;
};

TEST(OpenFastStates, Descriptions) {
  const Description all[] = {
      {"ED 1st tower fore-aft bending mode DOF (internal DOF index = DOF_TFA1), m", "1st tower fore-aft", "m",
       0, false},
      {"ED First time derivative of 1st tower side-to-side bending mode DOF (internal DOF index = DOF_TSS1), "
       "m/s",
       "1st tower side-to-side", "m/s", 0, true},
      {"ED 1st flapwise bending-mode DOF of blade 2 (internal DOF index = DOF_BF(2,1)), m", "1st flap", "m",
       2, false},
      {"ED First time derivative of 1st edgewise bending-mode DOF of blade 3 (internal DOF index = "
       "DOF_BE(3,1)), m/s",
       "1st edge", "m/s", 3, true},
      {"ED Variable speed generator DOF (internal DOF index = DOF_GeAz), rad", "generator azimuth", "rad", 0,
       false},
      {"ED Platform pitch tilt rotation DOF (internal DOF index = DOF_P), rad", "platform pitch", "rad", 0,
       false},
      {"ED Drivetrain rotational-flexibility DOF (internal DOF index = DOF_DrTr), rad", "drivetrain torsion",
       "rad", 0, false},
      {"something else", "something else", "", 0, false},
      {"", "", "", 0, false},
  };
  for (const Description& expected : all) {
    const OpenFastState state = openfast_state(expected.text);
    EXPECT_EQ(state.motion, expected.motion) << expected.text;
    EXPECT_EQ(state.unit, expected.unit) << expected.text;
    EXPECT_EQ(state.blade, expected.blade) << expected.text;
    EXPECT_EQ(state.is_rate, expected.is_rate) << expected.text;
  }
}

}  // namespace
}  // namespace eigentrail::test::openfast_states_test
