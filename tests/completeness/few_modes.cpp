#include "completeness/few_modes.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "completeness/discrepancies.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

/// A trace of few modes may have so many times the points of the trace of all, and so many besides.
constexpr int times_the_points = 3;
constexpr int further_points = 60;

bool is_compared(const Event& event) {
  return event.kind == EventKind::flutter || event.kind == EventKind::divergence ||
         event.kind == EventKind::collision;
}

/// The events of one list that another one does not have.
std::vector<Event> without(const std::vector<Event>& events, const std::vector<Event>& others, double range) {
  std::vector<Event> result;
  std::copy_if(events.begin(), events.end(), std::back_inserter(result), [&](const Event& event) {
    return is_compared(event) && std::none_of(others.begin(), others.end(), [&](const Event& other) {
             return other.kind == event.kind && std::abs(other.p - event.p) <= same_place * range;
           });
  });
  return result;
}

}  // namespace

std::vector<std::string> check_few_modes(const RandomFamily& family, const std::vector<int>& numbers) {
  const RecordedTrace all = record_trace(make_setting(family.scene(), {{"max_nodes", "5000"}}));
  const double range = std::abs(family.to - family.from);
  std::vector<std::string> problems;
  for (const int modes : numbers) {
    const RecordedTrace few =
        record_trace(make_setting(family.scene(), {{"max_nodes", "5000"}, {"modes", std::to_string(modes)}}));
    const auto problem = [&](const auto&... words) {
      std::ostringstream text;
      text.precision(12);
      text << modes << " modes: ";
      (text << ... << words);
      problems.push_back(text.str());
    };
    if (few.result.status != TraceStatus::completed) problem("ended early: ", few.result.message);
    for (const std::string& note : few.result.notes) problem("note: ", note);
    for (const Event& event : without(few.result.events, all.result.events, range))
      problem("invented: ", event_line(event));
    for (const Event& event : without(all.result.events, few.result.events, range)) {
      if (*std::min_element(event.modes.begin(), event.modes.end()) < modes)
        problem("missing: ", event_line(event));
    }
    if (few.result.nodes > times_the_points * all.result.nodes + further_points)
      problem(few.result.nodes, " points, of all modes ", all.result.nodes);
  }
  return problems;
}

}  // namespace eigentrail::test
