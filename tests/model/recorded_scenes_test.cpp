// What is recorded of scenes: elements of one structure share a record, absent effects have none.
#include <gtest/gtest.h>

#include "model/recorded_equations.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::recorded_scenes_test {
namespace {

const std::string three_springs =
    "[trace]\nparameter = \"k\"\nfrom = 1\nto = 2\n[parameters]\nk = 1\n"
    "[[point]]\nname = \"a\"\nmass = 1\nposition = [1, 2, 3]\n"
    "[[point]]\nname = \"b\"\nmass = \"2*k\"\nposition = [0, 1, 2]\n"
    "[[spring]]\nfrom = \"a\"\nto = \"b\"\nstiffness = \"k\"\nfree_length = 0.1\n"
    "[[spring]]\nfrom = \"b\"\nto = \"a\"\nstiffness = 0\nfree_length = \"0.3*k\"\n"
    "[[spring]]\nfrom = [0, 0, 0]\nto = \"a\"\nstiffness = 3\nfree_length = 0.2\n";

const Effect& effect(const Model& model, const std::string& name) {
  for (const Effect& one : model.description().effects) {
    if (one.name == name) return one;
  }
  throw std::out_of_range(name);
}

TEST(RecordedScenes, ElementsOfOneStructureShareARecord) {
  const Setting setting = make_setting(three_springs);
  EXPECT_EQ(effect(*setting.model, "point").records, 1);
  EXPECT_EQ(effect(*setting.model, "point").directions, 3);
  EXPECT_EQ(effect(*setting.model, "spring").count, 3);
  EXPECT_EQ(effect(*setting.model, "spring").records, 2);     // one end is fixed, or none
  EXPECT_EQ(effect(*setting.model, "spring").directions, 6);  // both ends
}

TEST(RecordedScenes, AbsentEffectsAreNotRecorded) {
  const Setting setting = make_setting(three_springs);
  for (const Effect& one : setting.model->description().effects) {
    if (one.count > 0) continue;
    EXPECT_EQ(one.records, 0) << one.name;
    EXPECT_EQ(one.operations, 0) << one.name;
    EXPECT_EQ(one.directions, 0) << one.name;
  }
}

/// A body whose axes are principal has four moments that are not zero, and no products with the others.
TEST(RecordedScenes, MomentsThatAreZeroAreNotRecorded) {
  const auto operations = [](const std::string& inertia) {
    return effect(*make_setting(
                       "[trace]\nparameter = \"k\"\nfrom = 1\nto = 2\n[parameters]\nk = 1\n[[body]]\nname = "
                       "\"c\"\nmass = 1\ninertia = " +
                       inertia +
                       "\nposition = [0, 0, 0]\n[gravity]\nacceleration = [0, 0, -9]\n"
                       "[[spring]]\nfrom = [1, 1, 1]\nto = \"c\"\nstiffness = \"k\"\nfree_length = 0.1\n")
                       .model,
                  "body")
        .operations;
  };
  EXPECT_LT(operations("[1, 1, 1]"), operations("[[1, 0.1, 0.1], [0.1, 1, 0.1], [0.1, 0.1, 1]]"));
}

}  // namespace
}  // namespace eigentrail::test::recorded_scenes_test
