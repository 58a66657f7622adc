#include "continuation/events/veering_partners.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/events/event_record.hpp"
#include "continuation/events/exceptional_point.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Largest number of exceptional points that are looked for from one prediction. Two modes that hardly
/// influence each other have two close ones.
constexpr int most_of_one_prediction = 3;
/// In units of the largest half-width: how far iterates may go from the prediction.
constexpr double reach_in_widths = 2.0;
/// In steps: exceptional points farther beyond the ends of the step, and farther than they are off the axis,
/// are left to other steps.
constexpr double beyond_the_step = 0.1;
/// As a share of the distance from the real axis: two roots of the discriminant closer than this are a double
/// root within rounding, where eigenvalues of independent modes coincide.
constexpr double double_root = 1e-5;
/// As a share of the distance of the two eigenvalues at the real axis: how well the dense output must agree.
constexpr double same_mode = 0.2;
/// As a share of the range: least half-width. Narrower ones are meetings on the axis.
constexpr double narrowest = 1e-10;

class PencilSearch {
 public:
  PencilSearch(const EventSearch& search, const Step& step, const ExpectedMeeting& expected,
               const std::vector<int>& modes, double widest, BelowExceptionalPoints& known)
      : search_(search), step_(step), expected_(expected), modes_(modes), widest_(widest), known_(known) {}

  VeeringsOfPencil run() {
    if (!go_to(expected_.position.real())) return {};
    FoundEvents found;
    std::vector<Complex> known = known_roots();
    std::optional<ExceptionalPoint> point;
    for (int i = 0; i < most_of_one_prediction; ++i) {
      point = point ? next_to(*point, known) : from_prediction(known);
      if (!point) break;
      known.push_back(point->h);
      if (auto event = event_at(*point)) found.events.push_back(std::move(*event));
    }
    if (!expected_.is_rough) {
      if (const auto mirrored = on_other_side()) {
        auto event = event_at(*mirrored);
        if (event && !is_in(found.events, *event)) found.events.push_back(std::move(*event));
      }
    }
    return {std::move(found), std::move(untold_)};
  }

  /// Puts a veering that was located otherwise where Newton's method leads from it; false where that is
  /// another place.
  bool settle(Event& event) {
    if (!go_to((event.p - step_.left->p) / search_.frame().speed(*step_.left))) return true;
    const double speed = search_.frame().speed(*node_);
    const double sign = std::signbit(expected_.position.imag()) ? -1.0 : 1.0;
    const Complex h((event.p - node_->p) / speed, sign * event.half_width / speed);
    const auto point = from_followed(h, {});
    const double same = search_.log.thresholds.event.same_veering * search_.frame().range.length();
    if (!point) return true;
    if (std::abs(point->h - h) * std::abs(speed) > same) return false;
    event.p = node_->p + point->h.real() * speed;
    event.half_width = std::abs(point->h.imag() * speed);
    return true;
  }

 private:
  const Track& track() const { return step_.left->tracks[expected_.a.track]; }
  Chart chart() const { return track().pair.chart; }
  const ReducedPencil& pencil() const { return node_->pencil.of(track().pair.part); }

  /// Computes the point at a distance from the left end, or at the nearer end of the step. False if that
  /// fails.
  bool go_to(double distance) {
    position_ = std::clamp(distance / step_.h, 0.0, 1.0) * step_.h;
    node_ = node_at(position_);
    return node_.has_value();
  }

  /// Equilibrium and pencil, as series, at a distance from the left end; without modes.
  std::optional<PathNode> node_at(double position) const {
    const bool right = position / step_.h > 0.5;
    const PathNode& nearer = right ? step_.right : *step_.left;
    const PathPoint point = search_.solver.reduce(nearer, position - (right ? step_.h : 0.0));
    if (point.status != PointStatus::computed) return std::nullopt;
    return differentiate_point(search_.problem(), point, search_.solver.counts());
  }

  /// Exceptional points of these modes that the log has, as distances from the point; with those on the other
  /// side of the axis, because a veering does not tell its side.
  std::vector<Complex> known_roots() const {
    std::vector<Complex> roots;
    const double speed = search_.frame().speed(*node_);
    const auto add = [&](const std::vector<Event>& events) {
      for (const Event& event : events) {
        if (event.kind != EventKind::veering || event.modes != modes_) continue;
        const Complex h((event.p - node_->p) / speed, event.half_width / speed);
        if (std::abs(h) > reach_in_widths * widest_ + std::abs(step_.h)) continue;
        roots.push_back(h);
        roots.push_back(std::conj(h));
      }
    };
    add(search_.log.events);
    if (search_.log.found != nullptr) add(search_.log.found->events);
    return roots;
  }

  /// The mean of the two eigenvalues at a predicted distance from the left end. It is smooth there, unlike
  /// each of them, so that the sum of their interpolants is accurate off the real axis; those of members of
  /// larger blocks are not known there, and taken from the axis.
  Complex mean_at_prediction(Complex distance) const {
    const Complex t = distance / step_.h;
    Complex sum = 0.0;
    double count = 0.0;
    for (const EigenvalueBranch* branch : {&expected_.a, &expected_.b}) {
      const Eigen::Index size = step_.left->tracks[branch->track].size();
      EigenvalueSampler sampler(*step_.left, step_.right, branch->track, step_.h);
      for (const int member : branch->members) {
        sum += size <= 2 ? sampler.functions()(t)[0] : sampler(position_ / step_.h)[member];
        count += 1.0;
      }
    }
    return sum / count;
  }

  /// A predicted eigenvalue at the point.
  Complex value_of(const EigenvalueBranch& branch) const {
    EigenvalueSampler sampler(*step_.left, step_.right, branch.track, step_.h);
    return sampler(position_ / step_.h)[branch.members.front()];
  }

  /// Another one beside one that was found, or from the prediction once more.
  std::optional<ExceptionalPoint> next_to(const ExceptionalPoint& point,
                                          const std::vector<Complex>& known) const {
    if (std::abs(point.next - point.h) < reach_in_widths * widest_) {
      if (auto beside = found_from(point.next, point.mu, known)) return beside;
    }
    return from_prediction(known);
  }

  std::optional<ExceptionalPoint> from_prediction(const std::vector<Complex>& known) const {
    const Complex h = expected_.position - position_;
    auto point = found_from(h, mean_at_prediction(expected_.position), known);
    return point || expected_.is_rough ? point : from_followed(h, known);
  }

  /// The exceptional point on the other side of the real axis. It is the mirror image only without damping:
  /// with light damping it lies so close to it that a veering that is known hides its prediction.
  std::optional<ExceptionalPoint> on_other_side() const {
    const Complex mirrored = std::conj(expected_.position);
    return found_from(mirrored - position_, mean_at_prediction(mirrored), {});
  }

  bool is_in(const std::vector<Event>& events, const Event& event) const {
    return std::any_of(events.begin(), events.end(), [&](const Event& other) {
      return are_one(other, event, search_.frame().range.length(), search_.log.thresholds.event);
    });
  }

  /// From h, with both eigenvalues followed there from the real axis.
  std::optional<ExceptionalPoint> from_followed(Complex h, const std::vector<Complex>& known) const {
    const auto mean = mean_at(pencil(), chart(), 0.0, h, {value_of(expected_.a), value_of(expected_.b)});
    return mean ? found_from(h, *mean, known) : std::nullopt;
  }

  std::optional<ExceptionalPoint> found_from(Complex h, Complex mu, const std::vector<Complex>& known) const {
    return find_exceptional_point(pencil(), chart(), h, mu, reach_in_widths * widest_, known);
  }

  std::optional<Event> event_at(const ExceptionalPoint& point) {
    const double speed = search_.frame().speed(*node_);
    const double range = search_.frame().range.length();
    Event event;
    event.kind = EventKind::veering;
    event.p = node_->p + point.h.real() * speed;
    event.half_width = std::abs(point.h.imag() * speed);
    const double t = (position_ + point.h.real()) / step_.h;
    const double beyond = std::max(beyond_the_step, std::abs(point.h.imag() / step_.h));
    const bool here = t > -beyond && t < 1.0 + beyond && search_.log.is_on_range(event);
    const bool counts = std::abs(point.h.imag()) <= widest_ && event.half_width >= narrowest * range &&
                        0.5 * std::abs(point.next - point.h) > double_root * std::abs(point.h.imag());
    if (!here || !counts) return std::nullopt;
    if (is_recorded(event, point, t)) return std::nullopt;
    const auto below = eigenvalues_below(pencil(), chart(), point);
    if (!below) return std::nullopt;
    known_.entries.push_back({position_ + point.h, point.mu, *below});
    event.modes = modes_of(*below, t);
    if (event.modes.size() != 2) {
      event.modes = modes_;
      untold_.push_back(std::move(event));
      return std::nullopt;
    }
    event.s = chart_value(0.5 * ((*below)[0].mu + (*below)[1].mu), chart());
    if (event.s.imag() < 0.0) event.s = std::conj(event.s);
    event.node = search_.node;
    const ComplexMatrix shape = node_->basis.shapes((*below)[0].z, track().pair.part);
    keep_shape(*node_, track().pair.part, shape.col(0), event);
    leave_unknown(search_.problem().model.description().parameters.size(), event);
    return search_.log.has_veering({event.p, event.half_width}, event.modes)
               ? std::nullopt
               : std::optional(std::move(event));
  }

  /// Whether the log has the veering of an exceptional point from which eigenvalues were followed down
  /// before.
  bool is_recorded(const Event& event, const ExceptionalPoint& point, double t) const {
    constexpr double same = 1e-7;  // of the distance from the axis, and of the eigenvalue
    return std::any_of(known_.entries.begin(), known_.entries.end(), [&](const auto& entry) {
      if (std::abs(position_ + point.h - entry.place) > same * std::abs(point.h.imag())) return false;
      if (std::abs(point.mu - entry.mu) > same * std::abs(point.mu)) return false;
      const std::vector<int> modes = modes_of(entry.below, t);
      return modes.size() == 2 && search_.log.has_veering({event.p, event.half_width}, modes);
    });
  }

  /// The modes of two eigenvalues at a place of the step or beside it, by the dense output. Where that is not
  /// accurate enough, by the predicted tracks computed there; empty if they do not tell either.
  std::vector<int> modes_of(const std::array<EigenvalueBelow, 2>& below, double t) const {
    std::vector<SeenTrack> seen;
    for (std::size_t i = 0; i < step_.left->tracks.size(); ++i) {
      const Track& other = step_.left->tracks[i];
      if (other.pair.part != track().pair.part || other.pair.chart != chart()) continue;
      EigenvalueSampler sampler(*step_.left, step_.right, i, step_.h);
      seen.push_back({i, sampler(std::clamp(t, 0.0, 1.0))});
    }
    const std::vector<int> modes = nearest_modes(below, seen);
    if (modes.size() == 2) return modes;
    std::erase_if(seen, [&](SeenTrack& one) { return !compute(t, one); });
    return nearest_modes(below, seen);
  }

  struct SeenTrack {
    std::size_t track;
    ComplexVector roots;  ///< in the order of its modes
  };

  /// Computes the eigenvalues of a predicted track at a place of the step or beside it. False for others, or
  /// if that fails.
  bool compute(double t, SeenTrack& seen) const {
    if (seen.track != expected_.a.track && seen.track != expected_.b.track) return false;
    const bool right = t > 0.5;
    const auto there = search_.solver.follow(one_track(right ? step_.right : *step_.left, seen.track),
                                             (right ? t - 1.0 : t) * step_.h);
    if (!there) return false;
    seen.roots = in_order_of(seen.roots, there->node.tracks.front().roots);
    return true;
  }

  /// The modes of the eigenvalues that are closest to the two; empty if one is not close, or both are one.
  std::vector<int> nearest_modes(const std::array<EigenvalueBelow, 2>& below,
                                 const std::vector<SeenTrack>& seen) const {
    const double allowed = same_mode * std::abs(below[0].mu - below[1].mu);
    std::vector<int> modes;
    for (const EigenvalueBelow& one : below) {
      double least = allowed;
      int nearest = Track::no_mode;
      for (const SeenTrack& candidate : seen) {
        const std::vector<int>& names = step_.left->tracks[candidate.track].modes;
        for (Eigen::Index k = 0; k < candidate.roots.size(); ++k) {
          const Complex s = candidate.roots[k];
          const double distance = std::min(std::abs(s - one.mu), std::abs(std::conj(s) - one.mu));
          const int mode = names[static_cast<std::size_t>(k)];
          if (distance > least || mode < 0) continue;
          least = distance;
          nearest = mode;
        }
      }
      if (nearest == Track::no_mode) return {};
      modes.push_back(nearest);
    }
    modes = sorted_modes(std::move(modes));
    return modes[0] == modes[1] ? std::vector<int>() : modes;
  }

  const EventSearch& search_;
  const Step& step_;
  const ExpectedMeeting& expected_;
  const std::vector<int>& modes_;
  double widest_;
  BelowExceptionalPoints& known_;
  double position_ = 0.0;  ///< of the point, as a distance from the left end
  std::optional<PathNode> node_;
  std::vector<Event> untold_;
};

}  // namespace

VeeringsOfPencil find_from_pencil(const EventSearch& search, const Step& step,
                                  const ExpectedMeeting& expected, const std::vector<int>& modes,
                                  double widest, BelowExceptionalPoints& known) {
  return PencilSearch(search, step, expected, modes, widest, known).run();
}

bool settle_by_pencil(const EventSearch& search, const Step& step, const ExpectedMeeting& expected,
                      const std::vector<int>& modes, double widest, Event& veering) {
  BelowExceptionalPoints none;
  return PencilSearch(search, step, expected, modes, widest, none).settle(veering);
}

}  // namespace eigentrail
