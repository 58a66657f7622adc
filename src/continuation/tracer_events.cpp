#include <algorithm>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"

namespace eigentrail {

void Tracer::find_events(double h, const PathNode& next) {
  const StageTimer timer(result_.counts.events_seconds);
  const EventWork work(result_.counts);
  find_zeros(h, next);
  find_veerings(h, next);
  record_branch_point(next);
  find_folds(h, next);
}

namespace {

/// Whether both are the same special point, seen from two steps. An exceptional point belongs to two
/// eigenvalues, whichever modes these are taken for on either side of it.
bool are_alike(const Event& a, const Event& b, double range) {
  if (a.kind != b.kind) return false;
  if (a.kind != EventKind::veering) {
    return a.modes == b.modes && std::abs(a.p - b.p) <= 1e-9 * range && std::abs(a.node - b.node) <= 2;
  }
  return std::abs(a.p - b.p) <= 1e-7 * range && std::abs(a.half_width - b.half_width) <= 1e-7 * range &&
         std::abs(a.s - b.s) <= 1e-6 * std::abs(a.s);
}

}  // namespace

void Tracer::add_event(Event event) {
  const double low = std::min(options_.from, options_.to) - 1e-12 * range();
  const double high = std::max(options_.from, options_.to) + 1e-12 * range();
  if (event.p < low || event.p > high) return;
  const bool known = std::any_of(result_.events.begin(), result_.events.end(),
                                 [&](const Event& other) { return are_alike(other, event, range()); });
  if (!known) result_.events.push_back(std::move(event));
}

std::optional<Tracer::Probe> Tracer::probe(const Prediction& prediction, const Matrix& basis) {
  PathPoint point = compute_point(problem_, prediction, basis, result_.counts);
  if (point.status != PointStatus::computed) return std::nullopt;
  std::optional<PathNode> node = differentiate_point(problem_, point, result_.counts);
  if (!node) return std::nullopt;
  return Probe{std::move(point), std::move(*node)};
}

/// The tracks of `base` followed to a distance from it.
std::optional<PathNode> Tracer::probe(const PathNode& base, double h) {
  std::optional<Probe> there = probe(predict(base, h), base.basis.T[0]);
  if (!there) return std::nullopt;
  return std::move(there->node);
}

}  // namespace eigentrail
