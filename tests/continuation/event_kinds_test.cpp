// The table of kinds of events.
#include "eigentrail/continuation/event_kinds.hpp"

#include <gtest/gtest.h>

#include <set>

namespace eigentrail::test::event_kinds_test {
namespace {

TEST(EventKinds, EveryKindHasOneRowWithNamesOfItsOwn) {
  std::set<std::string_view> names, symbols, keys;
  int expected = 0;
  for (const EventKindInfo& info : event_kinds()) {
    EXPECT_EQ(static_cast<int>(info.kind), expected++) << info.name;
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(symbols.insert(info.symbol).second) << info.name;
    EXPECT_EQ(find_event_kind(info.name), &info);
    EXPECT_EQ(&event_kind(info.kind), &info);
    EXPECT_NE(info.remark, nullptr);
    if (info.request.key.empty()) continue;
    EXPECT_TRUE(keys.insert(info.request.key).second) << info.name;
    EXPECT_NE(info.request.accepts, nullptr);
  }
  EXPECT_EQ(event_name(EventKind::branch_point), "branch_point");
}

TEST(EventKinds, NumbersAndNamesThatAreNoneAreTold) {
  EXPECT_EQ(find_event_kind("pitchfork"), nullptr);
  EXPECT_THROW(event_kind(static_cast<EventKind>(-1)), std::out_of_range);
  EXPECT_THROW(event_kind(static_cast<EventKind>(event_kinds().size())), std::out_of_range);
}

TEST(EventKinds, RemarksSayWhatAnEventIs) {
  EventFacts facts;
  EXPECT_EQ(event_kind(EventKind::flutter).remark(facts), "touches the imaginary axis");
  facts.direction = 1;
  EXPECT_EQ(event_kind(EventKind::flutter).remark(facts), "unstable above");
  facts.value = 0.05;
  EXPECT_EQ(event_kind(EventKind::damping_ratio).remark(facts), "ratio 0.05, falling");
  EXPECT_EQ(event_kind(EventKind::extremum).remark(facts), "least damping ratio 0.05");
  facts.half_width = 1.5e-3;
  EXPECT_EQ(event_kind(EventKind::veering).remark(facts), "half-width 0.0015");
  facts.puiseux = {0.5, -0.25};
  EXPECT_EQ(event_kind(EventKind::collision).remark(facts),
            "unstable above, Puiseux coefficient 0.5 - 0.25j");
  facts.direction = 0;
  EXPECT_EQ(event_kind(EventKind::collision).remark(facts), "Puiseux coefficient 0.5 - 0.25j");
  facts.puiseux = {7.0, -2e-18};
  EXPECT_EQ(event_kind(EventKind::collision).remark(facts), "Puiseux coefficient 7 + 0j");
  facts.puiseux = {1e-17, 0.5};
  EXPECT_EQ(event_kind(EventKind::collision).remark(facts), "Puiseux coefficient 0 + 0.5j");
}

}  // namespace
}  // namespace eigentrail::test::event_kinds_test
