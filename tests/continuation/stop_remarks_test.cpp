// What the user is told where steps become too small: the place, who is the reason, and what may help.
#include "continuation/trace/stop_remarks.hpp"

#include <gtest/gtest.h>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::stop_remarks_test {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A block of the modes 1 and 2, of which the second is nearly zero, and mode 3.
struct Stopped {
  Stopped()
      : planted(Planted::frequencies(uncoupled(Matrix{{1e-3, 1.0}, {2.0, 0.0}, {5.0, 0.0}}))),
        node(planted.family.point(0.0, {{{2.0 * j, 1e-3 * j}}, {{5.0 * j}}})) {
    planted.family.counts = {};
  }
  std::string message(Verdict::Kind kind, int track) {
    return too_small_message(planted.family.problem(), planted.options, node,
                             {kind, track, INFINITY, "a reason"});
  }
  PlantedSearch planted;
  PathNode node;
};

TEST(TooSmallMessage, TellsPlaceModesAndReason) {
  Stopped stopped;
  const std::string text = stopped.message(Verdict::Kind::uncertified, 0);
  EXPECT_TRUE(has(text, "after p = 0: mode 1, 2: a reason")) << text;
  EXPECT_TRUE(has(stopped.message(Verdict::Kind::uncertified, 1), "mode 3: a reason"));
}

TEST(TooSmallMessage, NamesNobodyWhereNoTrackIsTheReason) {
  Stopped stopped;
  const std::string text = stopped.message(Verdict::Kind::no_equilibrium, -1);
  EXPECT_TRUE(has(text, "after p = 0: a reason")) << text;
  EXPECT_FALSE(has(text, "mode")) << text;
}

TEST(TooSmallMessage, LeavesOutMembersWithoutANumber) {
  Stopped stopped;
  stopped.node.tracks[0].modes = {Track::guard, 1};
  EXPECT_TRUE(has(stopped.message(Verdict::Kind::mode_lost, 0), ": mode 2: a reason"));
  stopped.node.tracks[0].modes = {Track::guard, Track::no_mode};
  EXPECT_TRUE(has(stopped.message(Verdict::Kind::mode_lost, 0), "p = 0: a reason"));
}

/// An eigenvalue of one reference asks for more accuracy than rounding allows.
TEST(TooSmallMessage, AdvisesALargerReferenceBesideZero) {
  Stopped stopped;
  EXPECT_TRUE(has(stopped.message(Verdict::Kind::inaccurate, 0), "give a larger `reference`, now 0.001"));
  EXPECT_FALSE(has(stopped.message(Verdict::Kind::inaccurate, 1), "reference")) << "5 is not beside zero";
  EXPECT_FALSE(has(stopped.message(Verdict::Kind::uncertified, 0), "reference")) << "another reason";
  stopped.node.tracks[0].pair.chart = Chart::reciprocal;
  EXPECT_FALSE(has(stopped.message(Verdict::Kind::inaccurate, 0), "reference")) << "1/s is beside zero";
}

/// Two constraints whose rows enclose an angle.
TEST(TooSmallMessage, TellsThatConstraintsBecomeDependent) {
  for (const double angle : {0.1, 1e-4}) {
    Planted family({{Matrix::Identity(4, 4)},
                    {},
                    {Matrix(Vector{{1.0, 2.0, 3.0, 4.0}}.asDiagonal())},
                    {Matrix{{1.0, 0.0, 0.0, 0.0}, {std::cos(angle), std::sin(angle), 0.0, 0.0}}}});
    const PathNode node = family.point(0.0, {});
    const std::string text = too_small_message(family.problem(), options_on(-1.0, 1.0), node,
                                               {Verdict::Kind::no_equilibrium, -1, INFINITY, "a reason"});
    EXPECT_EQ(has(text, "constraints come to depend on each other"), angle < 1e-3) << text;
    EXPECT_EQ(has(text, "0.0001 rad"), angle < 1e-3) << text;
  }
}

}  // namespace
}  // namespace eigentrail::test::stop_remarks_test
