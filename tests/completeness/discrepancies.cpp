#include "completeness/discrepancies.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace eigentrail::test {
namespace {

constexpr double at_once = 1e-9;  ///< of the range, between a collision and a divergence
constexpr double on_axis = 1e-6;  ///< |Im s| / |s| of a collision on the real axis

std::string place(const std::string& kind, double p, Complex s) {
  std::ostringstream text;
  text.precision(12);
  text << kind << " at " << p << ", s ";
  text.precision(6);
  text << s.real();
  if (s.imag() != 0.0) text << (s.imag() < 0 ? " - " : " + ") << std::abs(s.imag()) << "j";
  return text.str();
}

std::string place(const ReferenceEvent& event) {
  return place(event.kind, event.p, event.s);
}

std::string place(const Event& event) {
  std::string text = place(event_name(event.kind), event.p, event.s) + ", modes";
  for (const int mode : event.modes) text += " " + std::to_string(mode + 1);
  return text;
}

bool is_compared(EventKind kind) {
  return kind == EventKind::flutter || kind == EventKind::divergence || kind == EventKind::collision ||
         kind == EventKind::crossing;
}

/// The kind as the reference has it.
std::string kind_of(const Event& event) {
  const bool off_axis = std::abs(event.s.imag()) > on_axis * std::abs(event.s);
  if (event.kind == EventKind::collision && off_axis) return "collision of pairs";
  return event_name(event.kind);
}

}  // namespace

std::vector<Discrepancy> find_discrepancies(const ReferenceEvents& reference,
                                            const std::vector<Event>& events, const Traced& traced) {
  const double range = std::abs(traced.to - traced.from);
  const double near = same_place * range;
  const auto [low, high] = std::minmax(traced.from, traced.reached);
  const auto is_undecided = [&](double p) {
    if (p < low + near || p > high - near) return true;
    return std::any_of(reference.touching.begin(), reference.touching.end(),
                       [&](const ReferenceEvent& touch) { return std::abs(touch.p - p) <= near; });
  };
  std::vector<Discrepancy> result;
  std::vector<bool> used(events.size(), false);
  for (const ReferenceEvent& expected : reference.events) {
    std::size_t best = events.size();
    double distance = near;
    double beside = INFINITY;  // of the nearest event of the kind
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (used[i] || kind_of(events[i]) != expected.kind) continue;
      const double d = std::abs(events[i].p - expected.p);
      beside = std::min(beside, d);
      if (d > distance) continue;
      distance = d;
      best = i;
    }
    if (best < events.size()) {
      used[best] = true;
      const bool right = expected.kind == "collision" || events[best].direction == expected.direction;
      if (!right && !is_undecided(expected.p)) {
        result.push_back({"direction of " + expected.kind, expected.p,
                          place(events[best]) + ", direction " + std::to_string(events[best].direction) +
                              " instead of " + std::to_string(expected.direction)});
      }
      continue;
    }
    if (is_undecided(expected.p)) continue;
    std::ostringstream text;
    text << "missing " << place(expected);
    double other = INFINITY;
    for (const ReferenceEvent& event : reference.events) {
      if (&event != &expected) other = std::min(other, std::abs(event.p - expected.p));
    }
    text.precision(3);
    if (std::isfinite(other)) text << ", next event " << other << " away";
    if (beside < 1e-2) text << ", one of the kind is listed " << beside << " away";
    // A light damper: the pair becomes real and one of both passes zero at once.
    const bool at_collision =
        expected.kind == "divergence" &&
        std::any_of(reference.events.begin(), reference.events.end(), [&](const ReferenceEvent& event) {
          return event.kind == "collision" && std::abs(event.p - expected.p) <= at_once * range;
        });
    result.push_back(
        {"missing " + expected.kind + (at_collision ? " at a collision" : ""), expected.p, text.str()});
  }
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (used[i] || !is_compared(events[i].kind) || is_undecided(events[i].p)) continue;
    result.push_back({"invented " + kind_of(events[i]), events[i].p, "invented " + place(events[i])});
  }
  return result;
}

RecordedTrace trace_family(const RandomFamily& family) {
  return record_trace(make_setting(family.scene(), {{"max_nodes", "5000"}}));
}

std::vector<std::string> check_completeness(const RandomFamily& family) {
  const ReferenceEvents reference = reference_events(family.matrices, family.from, family.to);
  std::vector<std::string> problems;
  for (const std::string& doubt : reference.doubts) problems.push_back("reference in doubt: " + doubt);
  RandomFamily traced = family;
  for (const char* direction : {"upward: ", "downward: "}) {
    const TraceResult result = trace_family(traced).result;
    for (const Discrepancy& found :
         find_discrepancies(reference, result.events, {traced.from, traced.to, result.reached}))
      problems.push_back(direction + found.text);
    if (result.status != TraceStatus::completed) {
      std::ostringstream text;
      text.precision(12);
      text << direction << "ended early at " << result.reached << ": " << result.message;
      problems.push_back(text.str());
    }
    std::swap(traced.from, traced.to);
  }
  return problems;
}

}  // namespace eigentrail::test
