// In no hard case an event is lost or added if a threshold of the event search is a third of its value or
// three times as large. Left out are veering.widest, which defines the veerings that are to be found, and the
// thresholds of the start of a trace, which end it with a message.
#include <gtest/gtest.h>

#include <algorithm>

#include "hard_cases/run_case.hpp"

namespace eigentrail::test::thresholds_test {
namespace {

constexpr Thresholds defaults;

/// Calls visit(name, member) for every threshold.
template <class Self, class Visitor>
void visit_thresholds(Self& self, Visitor&& visit) {
  visit("rounding.entries", self.rounding.entries);
  visit("criterion.near_axis", self.criterion.near_axis);
  visit("criterion.extremum", self.criterion.extremum);
  visit("meeting.at_point", self.meeting.at_point);
  visit("meeting.narrow", self.meeting.narrow);
  visit("meeting.beside_axis", self.meeting.beside_axis);
  visit("meeting.on_axis", self.meeting.on_axis);
  visit("veering.widest", self.veering.widest);
  visit("event.same_place", self.event.same_place);
  visit("event.same_double_root", self.event.same_double_root);
  visit("event.same_veering", self.event.same_veering);
  visit("event.same_eigenvalue", self.event.same_eigenvalue);
  visit("event.known_veering_share", self.event.known_veering_share);
  visit("event.known_veering", self.event.known_veering);
  visit("statics.branch_point_share", self.statics.branch_point_share);
  visit("statics.zero", self.statics.zero);
  visit("identity.merged_distance", self.identity.merged_distance);
  visit("identity.merged_assurance", self.identity.merged_assurance);
  visit("identity.least_assurance", self.identity.least_assurance);
}

/// Names of all thresholds that are varied.
std::vector<std::string> threshold_names() {
  std::vector<std::string> names;
  visit_thresholds(defaults, [&](const std::string& name, double) {
    if (name != "veering.widest") names.push_back(name);
  });
  return names;
}

Thresholds changed(const std::string& name, double factor) {
  Thresholds thresholds;
  visit_thresholds(thresholds, [&](const std::string& other, double& value) {
    if (other == name) value *= factor;
  });
  return thresholds;
}

std::string problems(const HardCase& hard_case, const RunSetting& setting) {
  const RecordedTrace trace = trace_case(hard_case, setting);
  const bool completed = trace.result.status == TraceStatus::completed;
  std::string text = completed ? "" : "ended early: " + trace.result.message + "; ";
  const EventComparison events = compare_events(hard_case, trace, setting.tolerance);
  for (const std::string& event : events.missing) text += "missing " + event + "; ";
  for (const std::string& event : events.invented) text += "invented " + event + "; ";
  return text;
}

class ThresholdCase : public testing::TestWithParam<HardCase> {};

TEST_P(ThresholdCase, NothingIsLostByAFactorOfThree) {
  std::string found;
  for (const std::string& name : threshold_names()) {
    for (const double factor : {1.0 / 3.0, 3.0}) {
      RunSetting setting;
      setting.thresholds = changed(name, factor);
      const std::string report = problems(GetParam(), setting);
      if (!report.empty()) found += name + (factor > 1.0 ? " * 3: " : " / 3: ") + report + "\n";
    }
  }
  EXPECT_TRUE(found.empty()) << found;
}

INSTANTIATE_TEST_SUITE_P(All, ThresholdCase, testing::ValuesIn(hard_cases()),
                         [](const auto& checked) { return checked.param.name; });

/// The list of thresholds names each of them once.
TEST(Thresholds, AreListedOnce) {
  std::vector<std::string> names;
  visit_thresholds(defaults, [&](const std::string& name, double value) {
    names.push_back(name);
    EXPECT_GT(value, 0.0) << name;
  });
  EXPECT_EQ(names.size() * sizeof(double), sizeof(Thresholds));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace eigentrail::test::thresholds_test
