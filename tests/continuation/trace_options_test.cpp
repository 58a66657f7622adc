#include "eigentrail/continuation/trace_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/input_error.hpp"

namespace eigentrail::test::trace_options_test {
namespace {

const std::string family = "[matrix_family]\nM = [ [[1]] ]\nK = [ [[1]], [[1]] ]\n";

TraceOptions read(const std::string& trace, const OptionTexts& overrides = {}) {
  std::set<int> used;
  return read_trace_options(parse_scene("[trace]\n" + trace + family, "scene.toml"), overrides, used);
}

TEST(TraceOptions, DefaultsAreDocumented) {
  const TraceOptions options = read("parameter = \"p\"\nfrom = 0\nto = 1\n");
  EXPECT_EQ(options.tolerance, 1e-6);
  EXPECT_FALSE(options.order || options.modes.count || options.reference || options.first_step ||
               options.max_step);
  EXPECT_TRUE(options.certify);
}

TEST(TraceOptions, CommandLineOverridesTheScene) {
  const TraceOptions options =
      read("parameter = \"p\"\nfrom = 0\nto = 1\nmodes = 3\n",
           {{"to", "2.5"}, {"modes", "all"}, {"tolerance", "1e-9"}, {"certify", "false"}});
  EXPECT_EQ(options.to, 2.5);
  EXPECT_FALSE(options.certify);
  EXPECT_TRUE(options.modes.is_all());
  EXPECT_EQ(options.tolerance, 1e-9);
}

TEST(TraceOptions, OrderIsANumberOrTheWordAuto) {
  const std::string range = "parameter = \"p\"\nfrom = 0\nto = 1\n";
  EXPECT_EQ(read(range + "order = 2\n").order, 2);
  EXPECT_FALSE(read(range + "order = \"auto\"\n").order);
  EXPECT_FALSE(read(range + "order = 2\n", {{"order", "auto"}}).order);
  EXPECT_EQ(read(range + "order = \"auto\"\n", {{"order", "4"}}).order, 4);
  // The word of another option.
  EXPECT_THROW(static_cast<void>(read(range + "order = \"all\"\n")), InputError);
  EXPECT_THROW(static_cast<void>(read(range + "modes = \"auto\"\n")), InputError);
}

TEST(TraceOptions, ModesAreANumberOrATableInTheSameWordsOnTheCommandLine) {
  const std::string range = "parameter = \"p\"\nfrom = 0\nto = 1\n";
  const ModeChoice wanted{.count = 12, .band = FrequencyBand{M_PI, 6 * M_PI}, .damping_below = 0.9};
  const auto near = [&](const ModeChoice& found) {
    EXPECT_EQ(found.count, wanted.count);
    EXPECT_EQ(found.damping_below, wanted.damping_below);
    ASSERT_TRUE(found.band.has_value());
    EXPECT_NEAR(found.band->lowest, wanted.band->lowest, 1e-12);
    EXPECT_NEAR(found.band->highest, wanted.band->highest, 1e-12);
  };
  near(read(range + "modes = { count = 12, band = [\"0.5 Hz\", \"180 rpm\"], damping_below = 0.9 }\n").modes);
  const TraceOptions overridden = read(
      range + "modes = 3\n", {{"modes", "count = 12, band = ['0.5 Hz', '180 rpm'], damping_below = 0.9"}});
  near(overridden.modes);
  ASSERT_EQ(overridden.events.wanted.size(), 2u) << "the ends of the band are looked for";
  EXPECT_EQ(overridden.events.wanted[0].kind, EventKind::band_edge);
  // The text in the loci file reads back as the same choice.
  for (const auto& [key, text] : describe_options(overridden)) {
    if (key != "modes") continue;
    EXPECT_EQ(read(range, {{"modes", text}}).modes, overridden.modes) << text;
  }
}

TEST(TraceOptions, ChoicesOfModesThatMakeNoSenseAreRefused) {
  const std::string range = "parameter = \"p\"\nfrom = 0\nto = 1\nmodes = ";
  const auto message = [&](const std::string& modes) {
    return input_error([&] { read(range + modes + "\n"); });
  };
  EXPECT_TRUE(contains(message("{ count = 1.5 }"), "whole number of at least 1, found 1.5"));
  EXPECT_TRUE(contains(message("{ count = 0 }"), "at least 1"));
  EXPECT_TRUE(contains(message("{ band = [3, 2] }"), "the lower one first"));
  EXPECT_TRUE(contains(message("{ band = [\"3 m\", \"4 m\"] }"), "found \"3 m\""));
  EXPECT_TRUE(contains(message("{ damping_below = 3 }"), "found 3"));
  EXPECT_TRUE(contains(message("{ near = 4 }"), "how many"));
  const std::string of_option = input_error([] {
    read("parameter = \"p\"\nfrom = 0\nto = 1\n", {{"modes", "count = 3]"}});
  });
  EXPECT_TRUE(contains(of_option, "expected keys with values")) << of_option;
  EXPECT_TRUE(contains(message("{ bands = [1, 2] }"), "did you mean 'band'"));
}

TEST(TraceOptions, NumbersAreInTheParametersUnitAndExpressionsInSi) {
  const Scene scene = parse_scene(
      "[parameters]\nspeed = { value = 10, unit = \"rpm\" }\nlimit = { value = 600, unit = \"rpm\" }\n"
      "[trace]\nparameter = \"speed\"\nfrom = 100\nto = \"limit\"\n",
      "scene.toml");
  std::set<int> used;
  const TraceOptions options = read_trace_options(scene, {}, used);
  EXPECT_EQ(options.from, 100.0);
  EXPECT_NEAR(options.to, 600.0, 1e-10);
}

TEST(TraceOptions, ProvenanceListsEveryOption) {
  const TraceOptions options = read("parameter = \"p\"\nfrom = 0.1\nto = 1\n");
  const OptionTexts texts = describe_options(options);
  int fields = 0;
  TraceOptions::fields(options, [&](const char*, const char*, const auto&) { ++fields; });
  EXPECT_EQ(static_cast<int>(texts.size()), fields);
  EXPECT_NE(std::find(texts.begin(), texts.end(), std::pair<std::string, std::string>("from", "0.1")),
            texts.end());
  EXPECT_NE(std::find(texts.begin(), texts.end(), std::pair<std::string, std::string>("modes", "all")),
            texts.end());
  EXPECT_NE(std::find(texts.begin(), texts.end(), std::pair<std::string, std::string>("certify", "true")),
            texts.end());
}

TEST(TraceOptions, BranchesAreANumberOrAList) {
  const std::string range = "parameter = \"p\"\nfrom = 0.1\nto = 1\n";
  EXPECT_TRUE(read(range).branch.empty());
  EXPECT_EQ(read(range + "branch = 2\n").branch, std::vector<int>{2});
  EXPECT_EQ(read(range + "branch = \"1, 3,2\"\n").branch, (std::vector<int>{1, 3, 2}));
}

}  // namespace
}  // namespace eigentrail::test::trace_options_test
