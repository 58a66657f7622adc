#include "continuation/events/part_crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "continuation/events/event_record.hpp"
#include "continuation/events/nearby_mode.hpp"
#include "continuation/events/roots_on_step.hpp"
#include "continuation/events/walk.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// As a share of the range: accuracy to which crossings are located.
constexpr double crossing_resolution = 1e-11;
/// In units of the resolution: moves up to this that no longer shrink are rounding.
constexpr double rounding_moves = 100.0;

/// An eigenvalue of a track that is a mode.
struct ModeOfTrack {
  std::size_t track = 0;
  Eigen::Index member = 0;
  int mode = 0;
  /// s by t. Every pair of modes is looked at in the same places first.
  std::map<double, Complex> known = {};
};

/// All modes of a step, by the dense output.
class ModesOnStep {
 public:
  explicit ModesOnStep(const Step& step) : step_(step) {
    for (std::size_t i = 0; i < step.left->tracks.size(); ++i) {
      samplers_.emplace_back(*step.left, step.right, i, step.h);
      const std::vector<int>& modes = step.left->tracks[i].modes;
      for (std::size_t k = 0; k < modes.size(); ++k) {
        if (modes[k] >= 0) all_.push_back({i, static_cast<Eigen::Index>(k), modes[k]});
      }
    }
  }

  std::vector<ModeOfTrack>& all() { return all_; }
  Chart chart(const ModeOfTrack& mode) const { return step_.left->tracks[mode.track].pair.chart; }

  /// The eigenvalue at t in its chart, and as s with Im s >= 0.
  Complex root(const ModeOfTrack& mode, double t) { return samplers_[mode.track](t)[mode.member]; }
  Complex s(ModeOfTrack& mode, double t) {
    const auto [known, is_new] = mode.known.try_emplace(t);
    if (is_new) known->second = upper_member(chart_value(root(mode, t), chart(mode)), Chart::finite);
    return known->second;
  }
  /// Rounding error of s.
  double resolution(ModeOfTrack& mode, double t) {
    const double of_root = samplers_[mode.track].resolution_at(t, mode.member, mode.member);
    return chart(mode) == Chart::finite ? of_root : of_root * std::norm(s(mode, t));
  }

 private:
  const Step& step_;
  std::vector<EigenvalueSampler> samplers_;  ///< per track
  std::vector<ModeOfTrack> all_;
};

/// Locates one crossing by Newton's method on the difference of both eigenvalues. Where they pass beside each
/// other, it leads to the place where they are closest.
class CrossingWalk {
 public:
  CrossingWalk(const EventSearch& search, const Step& step, ModesOnStep& on_step, const ModeOfTrack& a,
               const ModeOfTrack& b)
      : search_(search), step_(step), on_step_(on_step), modes_{&a, &b} {}

  std::optional<Event> from(double t) {
    for (std::size_t i = 0; i < 2; ++i) roots_[i] = on_step_.root(*modes_[i], t);
    const double speed = std::max(std::abs(search_.frame().speed(*step_.left)), 1e-300);
    const double resolution = crossing_resolution * search_.frame().range.length() / speed;
    const WalkRules rules{.resolution = resolution, .rounding = rounding_moves * resolution};
    const auto found = walk(t * step_.h, rules, [this](double h) { return look(h); });
    if (found.end != WalkEnd::settled) return std::nullopt;
    const double scale = std::max(std::abs(s_[0]), search_.problem().s_ref);
    const double same = search_.thresholds().identity.merged_distance;
    if (std::abs(s_[0] - s_[1]) > same * scale) return std::nullopt;  // they pass beside each other
    Event event = event_here();
    // By the error of the dense output it may lie on the step before or behind, if there is one.
    const double place = found.position / step_.h, rounding = rules.rounding / std::abs(step_.h);
    if (place < -rounding && --event.node == 0) return std::nullopt;
    if (place > 1.0 + rounding) {
      if (reached_end(search_.frame(), step_.right)) return std::nullopt;
      ++event.node;
    }
    return event;
  }

 private:
  Sight look(double h) {
    std::array<Complex, 2> slopes;
    for (std::size_t i = 0; i < 2; ++i) {
      seen_[i] =
          look_at_mode(search_.solver, *step_.left, modes_[i]->track, roots_[i], h, ModeFunction::eigenvalue);
      if (!seen_[i] || seen_[i]->series.size() < 2 || seen_[i]->series[0] == 0.0) return {};
      roots_[i] = seen_[i]->root;
      ComplexVector series = seen_[i]->series;
      if (on_step_.chart(*modes_[i]) == Chart::reciprocal) series = reciprocal_series(series);
      if (series[0].imag() < 0.0) series = series.conjugate().eval();
      s_[i] = series[0];
      slopes[i] = series[1];
    }
    ++looks_;
    const Complex rate = slopes[0] - slopes[1];
    if (!(std::abs(rate) > 0.0)) return {};
    return {Sight::Kind::seen, -((s_[0] - s_[1]) / rate).real()};
  }

  Event event_here() const {
    std::array<Event, 2> own;
    for (std::size_t i = 0; i < 2; ++i) {
      const PathNode& node = seen_[i]->solved.node;
      const Track& track = node.tracks.front();
      const std::vector<int> members{static_cast<int>(nearest_root(track.roots, seen_[i]->root))};
      keep_shape(node, track, members, 0.0, own[i]);
      keep_sensitivities(search_.problem(), solved_point(search_.problem(), node, search_.solver.counts()),
                         node, track, members, {}, own[i], search_.solver.counts());
    }
    Event event = own[0];
    event.copies.clear();  // equal modes of copies are modes of the same crossing
    event.kind = EventKind::crossing;
    event.p = seen_[0]->solved.node.p;
    event.s = 0.5 * (s_[0] + s_[1]);
    event.modes = {std::min(modes_[0]->mode, modes_[1]->mode), std::max(modes_[0]->mode, modes_[1]->mode)};
    event.node = search_.node;
    event.retrackings = looks_;
    event.sensitivity = 0.5 * (own[0].sensitivity + own[1].sensitivity);
    const ComplexVector apart = own[0].sensitivity - own[1].sensitivity;
    const Eigen::Index traced = search_.problem().traced;
    for (Eigen::Index q = 0; q < apart.size(); ++q) {
      const double shift = -(apart[q] / apart[traced]).real();
      if (q != traced && std::isfinite(shift)) event.shift[q] = shift;
    }
    return event;
  }

  const EventSearch& search_;
  const Step& step_;
  ModesOnStep& on_step_;
  std::array<const ModeOfTrack*, 2> modes_;
  std::array<Complex, 2> roots_;  ///< the eigenvalues in their charts, as they are expected at the next look
  std::array<std::optional<NearbyMode>, 2> seen_;  ///< at the last look
  std::array<Complex, 2> s_;                       ///< likewise
  int looks_ = 0;
};

/// Crossings of two modes on the step: of the roots of their difference near the real axis, those that
/// Newton's method confirms.
void add_crossings(const EventSearch& search, const Step& step, ModesOnStep& on_step, ModeOfTrack& a,
                   ModeOfTrack& b, FoundEvents& found) {
  constexpr double off_axis = 0.1;  // in steps
  // In steps: one at the end of the step may lie behind it, by the error of the dense output.
  constexpr double past_the_ends = 1e-3;
  RootsOnStep roots([&](double t) { return on_step.s(a, t) - on_step.s(b, t); },
                    [&](double t) { return on_step.resolution(a, t) + on_step.resolution(b, t); }, off_axis);
  for (const Complex root : roots.find()) {
    const double t = std::clamp(root.real(), 0.0, 1.0);
    if (std::abs(root.real() - t) > past_the_ends) continue;
    if (auto event = CrossingWalk(search, step, on_step, a, b).from(t))
      found.events.push_back(std::move(*event));
  }
}

/// Unites crossings at one place: where more than two modes coincide, every two of them do.
void unite(const EventSearch& search, std::vector<Event>& events) {
  const double place = search.thresholds().event.same_place * search.frame().range.length();
  for (std::size_t i = 0; i < events.size(); ++i) {
    for (std::size_t j = i + 1; j < events.size();) {
      const double scale = std::max(std::abs(events[i].s), search.problem().s_ref);
      const bool is_one =
          std::abs(events[i].p - events[j].p) <= place &&
          std::abs(events[i].s - events[j].s) <= search.thresholds().identity.merged_distance * scale;
      if (!is_one) {
        ++j;
        continue;
      }
      events[i].modes = sorted_modes(united(events[i].modes, events[j].modes));
      events.erase(events.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

}  // namespace

FoundEvents find_part_crossings(const EventSearch& search, const Step& step) {
  FoundEvents found;
  if (step.left->pencil.parts.size() < 2) return found;
  const auto& ranges = search.problem().parts->ranges;
  const auto kind_of = [&](const ModeOfTrack& mode) {
    return ranges[static_cast<std::size_t>(step.left->tracks[mode.track].pair.part)].like;
  };
  ModesOnStep on_step(step);
  std::vector<ModeOfTrack>& modes = on_step.all();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Modes of equal parts coincide throughout, or where those of one part meet.
      if (kind_of(modes[i]) != kind_of(modes[j]))
        add_crossings(search, step, on_step, modes[j], modes[i], found);
    }
  }
  unite(search, found.events);
  return found;
}

}  // namespace eigentrail
