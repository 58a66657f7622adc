// Scenes beyond the limits are rejected with a message that names the place.
#include "eigentrail/scene/limits.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/scene/units.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::limits_test {
namespace {

using test::contains;
using test::input_error;

constexpr const char* trace = "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[parameters]\np = 0\n";

/// The error message for a scene.
std::string fault(const std::string& text) {
  return input_error([&] { (void)prepare_trace(parse_scene(text, "test.toml"), {}); });
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

TEST(SceneLimits, EachIsReportedWhereItIsExceeded) {
  const std::string deep = "x = " + repeated("[", 20) + repeated("]", 20) + "\n";
  std::string parameters = "[parameters]\n";
  for (std::size_t i = 0; i <= limits::parameters; ++i) parameters += "p" + std::to_string(i) + " = 1\n";
  const std::vector<std::pair<std::string, std::string>> table = {
      {deep, "test.toml:1:21: lists and tables nested deeper than 16 levels"},
      {"a = 1\n" + std::string(300, 'k') + " = 1\n", "test.toml:2:304: a key of more than 200 characters"},
      {"title = \"" + std::string(5000, 't') + "\"\n", "test.toml:1:9: a text of more than 4096 characters"},
      {parameters, "test.toml:1002:1: [parameters] p1000: is one too many; a scene has at most 1000"},
      {trace + repeated("[[spring]]\n", limits::tables_of_a_kind + 1) +
           "[[point]]\nname=\"a\"\nmass=1\nposition=[0,0,0]\n",
       "test.toml:10007:1: spring: a scene has at most 10000 of these"},
      {trace + std::string("[events]\nharmonics = [") + repeated("1, ", limits::list_length) + "1]\n",
       "[events] harmonics: expected at most 1000 numbers, found 1001"}};
  for (const auto& [text, expected] : table) {
    const std::string found = fault(text);
    EXPECT_TRUE(contains(found, expected)) << expected << "\n" << found.substr(0, 300);
  }
}

TEST(SceneLimits, TurnsThatRepeatLongExpressionsAreReportedAtTheirTable) {
  const std::string angle = "\"1 + p" + repeated(" + p", 1000) + "\"";
  const std::string scene =
      std::string(trace) +
      "[[body]]\nname = \"b\"\nmass = 1\nposition = [0, 0, 0]\neuler = { sequence = \"zyx\", "
      "angles = [" +
      angle + ", " + angle + ", " + angle + "] }\n[[revolute]]\nfrom = [0, 0, 0]\nto = \"b\"\naxis = [" +
      angle + ", " + angle + ", " + angle + "]\n";
  const std::string found = fault(scene);
  EXPECT_TRUE(contains(found, "test.toml:12:1: [[revolute]] 1: ")) << found;
  EXPECT_TRUE(contains(found, "give parts of it a name in [parameters]")) << found;
}

TEST(SceneLimits, LongNamesAreNotComparedLetterByLetter) {
  std::string scene = trace;
  for (const char* letter : {"a", "b", "c", "d"})
    scene += "[[point]]\nname = \"" + repeated(letter, 4000) + "\"\nmass = 1\nposition = [0, 0, 0]\n";
  scene += "[[fixed]]\ncoordinate = \"x\"\npoint = \"" + repeated("e", 4000) + "\"\n";
  EXPECT_TRUE(contains(fault(scene), "no point is called"));
}

TEST(SceneLimits, UnitsBeyondTheRangeOfNumbersAreNone) {
  EXPECT_FALSE(unit_factor(repeated("km^12 ", 10)));
  EXPECT_FALSE(unit_factor(repeated("nm^12 ", 10)));
}

TEST(SceneLimits, HarmonicsOfAParameterThatDoesNotExistAreNoReasonToEnd) {
  const std::string scene = "[trace]\nparameter = \"speed\"\nfrom = 0\nto = 1\n[events]\nharmonics = 1\n";
  EXPECT_TRUE(contains(fault(scene), "no parameter is called 'speed'")) << fault(scene);
}

}  // namespace
}  // namespace eigentrail::test::limits_test
