#include "projection/scouted_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eigentrail/continuation/trace.hpp"

namespace eigentrail {
namespace {

/// A rough trace has at least this many steps, so that places between the samples are seen.
constexpr int scout_steps = 16;

/// Places that are closer than this share of the longest step to the one before are left out: the indicator
/// changes with the distance from the samples, and not where eigenvalues bend. Where some of them meet it is
/// another one, and such places stay.
constexpr double least_distance = 0.5;

/// Largest finite magnitude.
double largest_of(const std::vector<ProjectedMode>& modes) {
  double largest = 0.0;
  for (const ProjectedMode& mode : modes) {
    if (std::isfinite(std::abs(mode.s))) largest = std::max(largest, std::abs(mode.s));
  }
  return largest;
}

/// Replaces the modes of a place by those of another space. False if one is not found there.
bool renew(ProjectedPlace& place, SmallPencil small) {
  const double largest = largest_of(place.modes);
  for (ProjectedMode& mode : place.modes) {
    if (std::abs(mode.s) <= rigid * largest) continue;  // nobody uses its vectors
    RefinedMode refined = refined_mode(small, mode.s, {});
    if (!refined.is_settled) return false;
    mode = std::move(refined.mode);
  }
  place.small = std::move(small);
  place.is_old = false;
  return true;
}

bool has_meeting(const TracePoint& point) {
  return std::any_of(point.node.tracks.begin(), point.node.tracks.end(),
                     [](const Track& track) { return track.departure.has_value(); });
}

}  // namespace

Worst ScoutedPlaces::worst(const Model& model, bool traces_hold, double enough) {
  if (traces_hold) {
    forget_modes();
    if (const auto found = find_worst(model, enough)) return *found;
  }
  places_.clear();
  for (const ParameterValues& line : lines_) scout(model, line);
  indicators_.assign(places_.size(), std::nullopt);
  return find_worst(model, enough).value();
}

void ScoutedPlaces::scout(const Model& model, const ParameterValues& line) {
  TraceOptions options = trace_;
  options.values = line;
  options.tolerance = std::max(trace_.tolerance, scout_tolerance);
  options.certify = false;
  options.events = {};
  options.events.veerings = false;
  options.events.other_paths = false;
  options.order.reset();
  options.max_step = std::abs(trace_.to - trace_.from) / scout_steps;
  const double close = least_distance * *options.max_step;
  const std::size_t before = places_.size();
  TraceObserver observer;
  observer.started = [this](const TraceStart& start) { reference_ = start.s_ref; };
  observer.point = [&](const TracePoint& point) {
    const double p = point.node.p;
    const bool is_close = places_.size() > before && std::abs(p - places_.back().at.p) < close;
    if (is_close && p != trace_.to && !has_meeting(point)) return true;
    const Path& path = point.node.path;
    ProjectedPlace& place = places_.emplace_back();
    place.at = {p, path.parameters.col(0), path.x.col(0), path.lambda.col(0)};
    place.small = large_.small(model, point);
    for (const ModeState& mode : point.modes) {
      const ComplexVector shape =
          mode.shape.size() > 0 ? large_.coordinates(point, mode.shape) : ComplexVector();
      place.modes.push_back(refined_mode(place.small, mode.s, shape).mode);
    }
    return true;
  };
  const TraceResult result = trace(model, options, observer);
  if (places_.empty()) throw NotProjected("the projected model cannot be traced: " + result.message);
}

std::vector<ProjectedMode> ScoutedPlaces::moving_modes(const ProjectedPlace& place) {
  std::vector<ProjectedMode> modes = place.modes;
  std::erase_if(modes, [largest = largest_of(modes)](const ProjectedMode& mode) {
    return !std::isfinite(std::abs(mode.s)) || std::abs(mode.s) <= rigid * largest;
  });
  return modes;
}

/// Compares a place with the worst one. False if the modes of an old place are not found again.
bool ScoutedPlaces::look_at(const Model& model, std::size_t i, Worst& worst) {
  if (!indicators_[i]) indicators_[i] = indicator_at(model, places_[i]);
  if (indicators_[i] && *indicators_[i] > worst.indicator) worst = {&places_[i], *indicators_[i]};
  return indicators_[i].has_value();
}

/// Empty if the modes of an old place are not found again.
std::optional<Worst> ScoutedPlaces::find_worst(const Model& model, double enough) {
  Worst worst{&places_.front(), -1.0};
  for (std::size_t i = 0; i < places_.size(); i += 2) {
    if (!look_at(model, i, worst)) return std::nullopt;
  }
  const bool is_enough = worst.indicator > enough;
  const auto middle = static_cast<std::size_t>(worst.place - places_.data());
  for (std::size_t i = 1; i < places_.size(); i += 2) {
    const bool is_beside = i + 1 == middle || i == middle + 1;
    if ((is_beside || !is_enough) && !look_at(model, i, worst)) return std::nullopt;
  }
  return worst;
}

Worst ScoutedPlaces::worst_of_all(const Model& model) {
  const auto found = find_worst(model, INFINITY);
  return found ? *found : worst(model, false, INFINITY);
}

std::optional<Worst> ScoutedPlaces::correct_for(const Model& model) {
  forget_modes();
  return find_worst(model, INFINITY);
}

void ScoutedPlaces::forget_modes() {
  for (ProjectedPlace& place : places_) place.is_old = true;
  indicators_.assign(places_.size(), std::nullopt);
}

/// The largest indicator of the modes at a place, which are corrected if they are of another space. Empty if
/// they are not found.
std::optional<double> ScoutedPlaces::indicator_at(const Model& model, ProjectedPlace& place) const {
  const SparsePencil pencil = large_.pencil(place.at);
  const auto bases = large_.bases(model, pencil);
  if (!bases) return place.is_old ? std::nullopt : std::optional(0.0);
  if (place.is_old && !renew(place, large_.small(model, place.at, pencil, *bases->right)))
    return std::nullopt;
  const std::vector<ProjectedMode> modes = lifted(moving_modes(place), *bases->right, *bases->left);
  const std::vector<EigenvalueError> errors = eigenvalue_errors(pencil, modes);
  double largest = 0.0;
  for (std::size_t i = 0; i < modes.size(); ++i)
    largest = std::max(largest, errors[i].relative_to(size(modes[i].s)));
  return largest;
}

double ScoutedPlaces::distance(const ProjectedPlace& place, const std::vector<Complex>& exact) const {
  double largest = 0.0;
  for (const ProjectedMode& mode : moving_modes(place)) {
    EigenvalueError error{std::numeric_limits<double>::infinity()};
    for (const Complex other : exact) error.distance = std::min(error.distance, std::abs(other - mode.s));
    error.half_gap = half_gap(place.small, mode);
    largest = std::max(largest, error.relative_to(size(mode.s)));
  }
  return largest;
}

}  // namespace eigentrail
