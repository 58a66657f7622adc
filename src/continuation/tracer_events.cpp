#include <algorithm>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"

namespace eigentrail {

void Tracer::find_events(double h, const PathNode& next) {
  const StageTimer timer(result_.counts.events_seconds);
  const EventWork work(result_.counts);
  find_axis_crossings(h, next);
  find_veerings(h, next);
  find_folds(h, next);
}

/// A special point that two steps have seen is one.
void Tracer::add_event(Event event) {
  const double same = event.kind == EventKind::veering ? 1e-7 : 1e-9;
  const double low = std::min(options_.from, options_.to) - 1e-12 * range();
  const double high = std::max(options_.from, options_.to) + 1e-12 * range();
  if (event.p < low || event.p > high) return;
  for (const Event& other : result_.events) {
    const bool alike = other.kind == event.kind && other.modes == event.modes;
    if (alike && std::abs(other.p - event.p) <= same * range() && other.node + 2 >= event.node) return;
  }
  result_.events.push_back(std::move(event));
}

/// The tracks of `base` followed to a distance from it.
std::optional<PathNode> Tracer::probe(const PathNode& base, double h) {
  const PathPoint point = compute_point(problem_, predict(base, h), base.basis.T[0], result_.counts);
  if (point.status != PointStatus::computed) return std::nullopt;
  return differentiate_point(problem_, point, result_.counts);
}

}  // namespace eigentrail
