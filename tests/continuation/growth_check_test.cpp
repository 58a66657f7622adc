// The number of growing eigenvalues at both ends of a step, against the events on it. s^2 - p s + 1: the pair
// grows from p = 0 on.
#include "continuation/events/step_checks.hpp"

#include <gtest/gtest.h>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::growth_check_test {
namespace {

struct Growing {
  static std::vector<Together> pair_at(double p, bool as_block) {
    const Complex s = 0.5 * p + std::sqrt(Complex(0.25 * p * p - 1.0));
    return as_block ? std::vector<Together>{{{s, std::conj(s)}}} : std::vector<Together>{{{s}}};
  }
  std::optional<std::string> remark(double from, double to, bool as_block = false) {
    left = planted.family.point(from, pair_at(from, as_block));
    return unexplained_growth(planted.search, planted.step(left, to, pair_at(to, as_block)));
  }
  void add(EventKind kind, double p, int direction) {
    Event event;
    event.kind = kind;
    event.p = p;
    event.direction = direction;
    event.modes = {0};
    planted.events.push_back(event);
  }
  PlantedSearch planted{Planted({{Matrix{{1.0}}}, {Matrix{{0.0}}, Matrix{{-1.0}}}, {Matrix{{1.0}}}})};
  PathNode left;
};

TEST(GrowthCheck, SaysWhereAFlutterIsMissing) {
  for (const bool as_block : {false, true}) {
    Growing growing;
    const auto remark = growing.remark(-0.1, 0.2, as_block);
    ASSERT_TRUE(remark);
    EXPECT_NE(remark->find("between p = -0.1 and 0.2"), std::string::npos) << *remark;
    EXPECT_NE(remark->find("changes by 2"), std::string::npos) << *remark;
    EXPECT_NE(remark->find("by 0"), std::string::npos) << *remark;
  }
}

TEST(GrowthCheck, IsSilentWhereTheEventsExplainTheChange) {
  Growing growing;
  growing.add(EventKind::flutter, 0.0, 1);
  growing.add(EventKind::collision, 0.05, 0);
  EXPECT_FALSE(growing.remark(-0.1, 0.2));
  EXPECT_FALSE(growing.remark(0.2, -0.1)) << "against the direction of p";
  EXPECT_FALSE(growing.remark(0.1, 0.2));
}

TEST(GrowthCheck, SeesAWrongDirectionAndAnInventedEvent) {
  Growing growing;
  growing.add(EventKind::flutter, 0.0, -1);
  EXPECT_TRUE(growing.remark(-0.1, 0.2));
  growing.add(EventKind::divergence, 0.25, 1);
  EXPECT_TRUE(growing.remark(0.2, 0.3));
}

/// At p = 0 the pair is on the imaginary axis; at a fold or branch point the number depends on the path.
TEST(GrowthCheck, SaysNothingWhereNothingIsKnown) {
  Growing growing;
  EXPECT_FALSE(growing.remark(0.0, 0.2));
  growing.add(EventKind::branch_point, 0.0, 0);
  EXPECT_FALSE(growing.remark(-0.1, 0.2));
}

}  // namespace
}  // namespace eigentrail::test::growth_check_test
