// Options of the boundary search: their sources, and errors that are reported before the search.
#include "eigentrail/stability/boundary_options.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "eigentrail/core/errors.hpp"
#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_options_test {
namespace {

const std::string damped = freedoms({{"P + Q", "4"}});

/// The error message, empty if there is no error.
std::string refusal(const std::string& scene, const std::function<void(BoundaryRequest&)>& change) {
  BoundaryRequest request = square_window();
  change(request);
  try {
    prepare_boundary(parse_scene(scene, "test.toml"), request);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(BoundaryOptions, WindowsAndParametersThatMakeNoSenseAreRefused) {
  const auto expect = [](const char* fragment, const std::function<void(BoundaryRequest&)>& change) {
    const std::string message = refusal(damped, change);
    EXPECT_NE(message.find(fragment), std::string::npos) << "'" << message << "' lacks: " << fragment;
  };
  expect("--second: 'P' is the first parameter already", [](auto& r) { r.second = "P"; });
  expect("--second: no parameter is called 'Qq'; did you mean 'Q'?", [](auto& r) { r.second = "Qq"; });
  expect("--to: expected more than --from (-1), found -1: the window is empty", [](auto& r) { r.to = -1.0; });
  expect("--to: expected more than --from (-1), found -2", [](auto& r) { r.to = -2.0; });
  expect("--from: is not a finite number", [](auto& r) { r.from = -INFINITY; });
  expect("--to: is not a finite number", [](auto& r) { r.to = NAN; });
  expect("--damping-ratio: must lie between -1 and 1; found 1", [](auto& r) { r.damping_ratio = 1.0; });
  expect("--lines: must lie between 0 and 1000; found -1", [](auto& r) { r.lines = -1; });
  expect("[trace] to: equals from (-1)", [](auto& r) { r.first_to = -1.0; });
  expect("--first-from: is missing; the range in the scene is not that of 'Q'", [](auto& r) {
    r.parameter = "Q";
    r.second = "P";
  });
  EXPECT_EQ(refusal(damped, [](auto&) {}), "");
}

TEST(BoundaryOptions, ASecondParameterThatTheModelDoesNotContainIsRefused) {
  const std::string message = refusal(freedoms({{"P", "4"}}), [](auto&) {});
  EXPECT_NE(message.find("[parameters] Q: nothing in the scene uses this parameter"), std::string::npos)
      << message;
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
      std::string message;
      try {
        if (traced) {
          prepare_trace(parse_scene(scene, "test.toml"), {});
        } else {
          prepare_boundary(parse_scene(scene, "test.toml"), square_window());
        }
      } catch (const InputError& error) {
        message = error.what();
      }
      EXPECT_EQ(message.find("test.toml:"), 0U) << message;
      EXPECT_NE(message.find(fragment), std::string::npos) << message;
    }
  };
  expect("damping_ratio = 1.5", "[events] damping_ratio: must lie between -1 and 1; found 1.5");
  expect("damping_ratio = \"P\"", "[events] damping_ratio: expected numbers without parameters");
  expect("dampin_ratio = 0.1", "[events] dampin_ratio: unknown key; did you mean 'damping_ratio'?");
}

}  // namespace
}  // namespace eigentrail::test::boundary_options_test
