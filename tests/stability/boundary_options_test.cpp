// Options of the boundary search: their sources, and errors that are reported before the search.
#include "eigentrail/stability/boundary_options.hpp"

#include <gtest/gtest.h>

#include "scene/input_error.hpp"
#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_options_test {
namespace {

const std::string damped = freedoms({{"P + Q", "4"}});

TEST(BoundaryOptions, ASecondParameterThatTheModelDoesNotContainIsRefused) {
  const std::string message = input_error([] {
    prepare_boundary(parse_scene(freedoms({{"P", "4"}}), "test.toml"), square_window());
  });
  EXPECT_TRUE(contains(message, "[parameters] Q: nothing in the scene uses this parameter")) << message;
}

TEST(BoundaryOptions, TheDampingRatioOfTheSceneHoldsUnlessTheRequestHasOne) {
  const std::string scene = damped + "[events]\ndamping_ratio = \"1 / 4\"\n";
  const auto ratio = [&scene](std::optional<double> given) {
    BoundaryRequest request = square_window();
    request.damping_ratio = given;
    return prepare_boundary(parse_scene(scene, "test.toml"), request).options.damping_ratio;
  };
  EXPECT_EQ(ratio(std::nullopt), 0.25);
  EXPECT_EQ(ratio(0.1), 0.1);
  EXPECT_EQ(ratio(0.0), std::nullopt) << "the imaginary axis";
}

TEST(BoundaryOptions, FaultsOfTheEventsTableHaveTheirPlace) {
  const auto expect = [](const char* line, const char* fragment) {
    const std::string scene = damped + "[events]\n" + line + "\n";
    for (const bool traced : {true, false}) {
      const std::string message = input_error([&] {
        if (traced) {
          prepare_trace(parse_scene(scene, "test.toml"), {});
        } else {
          prepare_boundary(parse_scene(scene, "test.toml"), square_window());
        }
      });
      EXPECT_EQ(message.find("test.toml:"), 0U) << message;
      EXPECT_TRUE(contains(message, fragment)) << message;
    }
  };
  expect("damping_ratio = 1.5", "[events] damping_ratio: must lie between -1 and 1; found 1.5");
  expect("damping_ratio = \"P\"", "[events] damping_ratio: expected numbers without parameters");
  expect("dampin_ratio = 0.1", "[events] dampin_ratio: unknown key; did you mean 'damping_ratio'?");
}

}  // namespace
}  // namespace eigentrail::test::boundary_options_test
