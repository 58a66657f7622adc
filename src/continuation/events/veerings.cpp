#include "continuation/events/veerings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/events/event_record.hpp"
#include "continuation/events/exceptional_point.hpp"
#include "continuation/events/expected_meetings.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Relative increase of the largest half-width, so that a veering exactly on the limit is found.
constexpr double limit_rounding = 1e-9;
/// Smallest |dp/dsigma| by which a half-width in p is converted to the path's coordinate. Near a fold, where
/// dp/dsigma vanishes, the search would otherwise become too wide.
constexpr double least_speed = 1e-3;
/// Largest half-width of the search, in units of the range.
constexpr double widest_search = 2.0;
/// Largest number of exceptional points that are looked for from one prediction: those of the two modes,
/// after some of one of them with others, which may be nearer.
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

/// Half-width up to which veerings are searched for, in the coordinate along the path.
double search_width(const EventSearch& search, const PathNode& node) {
  const PathFrame& frame = search.frame();
  const double range = frame.range.length();
  const double speed = frame.plane ? std::abs(frame.speed(node)) : 1.0;
  const double widest = search.thresholds().veering.widest * (1.0 + limit_rounding);
  return std::min(widest * range / std::max(speed, least_speed), widest_search * range);
}

/// A pencil without the last two terms of series of the highest order, which are truncated; empty where none
/// is so long.
std::optional<ReducedPencil> shortened(const ReducedPencil& pencil) {
  ReducedPencil shorter{pencil.M, pencil.C, pencil.K};
  shorter.complex_sign = pencil.complex_sign;
  bool is_truncated = false;
  for (MatrixSeries* series : {&shorter.M, &shorter.C, &shorter.K}) {
    if (series->size() <= max_order) continue;
    series->resize(max_order - 1);
    is_truncated = true;
  }
  return is_truncated ? std::optional(std::move(shorter)) : std::nullopt;
}

/// The veerings to which Newton's method for exceptional points leads from one prediction, up to `widest` off
/// the real axis (in the coordinate along the path). Near a veering the square of the distance of the two
/// eigenvalues is a parabola: it has two roots, one on either side of the axis, or both on one side where the
/// two hardly influence each other.
class VeeringSearch {
 public:
  /// Those of the log are not found again. Adds to `found`, which the log refers to.
  VeeringSearch(const EventSearch& search, const Step& step, const ExpectedMeeting& expected,
                const std::vector<int>& modes, double widest, FoundEvents& found)
      : search_(search), step_(step), expected_(expected), modes_(modes), widest_(widest), found_(found) {
    highest_.order = max_order - 1;
  }

  void run() {
    if (!go_to(expected_.position.real())) return;
    std::vector<Complex> known = known_roots();
    std::optional<ExceptionalPoint> point;
    int own = 0;
    for (int i = 0; i < most_of_one_prediction && own < 2; ++i) {
      point = point ? next_to(*point, known) : from_prediction(known);
      if (!point) break;
      known.push_back(point->h);
      if (keep(*point)) ++own;
    }
    if (own == 2 || expected_.is_rough) return;
    if (const auto mirrored = on_other_side()) keep(*mirrored);
  }

 private:
  const Track& track() const { return step_.left->tracks[expected_.a.track]; }
  Chart chart() const { return track().pair.chart; }
  const ReducedPencil& pencil() const { return node_->pencil.of(track().pair.part); }

  /// Computes equilibrium and pencil, as series, without modes, at a distance from the left end, or at the
  /// nearer end of the step. False if that fails.
  bool go_to(double distance) {
    position_ = std::clamp(distance / step_.h, 0.0, 1.0) * step_.h;
    const auto [nearer, beyond] = from_nearer_end(position_);
    const PathPoint point = search_.solver.reduce(nearer, beyond);
    if (point.status == PointStatus::computed)
      node_ = differentiate_point(highest_, point, search_.solver.counts());
    return node_.has_value();
  }

  /// The point of the step at `position` or beyond its ends, seen from the nearer end.
  struct FromEnd {
    const PathNode& node;
    double distance;
  };
  FromEnd from_nearer_end(double position) const {
    const bool right = position / step_.h > 0.5;
    return {right ? step_.right : *step_.left, position - (right ? step_.h : 0.0)};
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

  /// From h, with both eigenvalues followed there from the real axis.
  std::optional<ExceptionalPoint> from_followed(Complex h, const std::vector<Complex>& known) const {
    const auto mean = mean_at(pencil(), chart(), 0.0, h, {value_of(expected_.a), value_of(expected_.b)});
    return mean ? found_from(h, *mean, known) : std::nullopt;
  }

  std::optional<ExceptionalPoint> found_from(Complex h, Complex mu, const std::vector<Complex>& known) const {
    return find_exceptional_point(pencil(), chart(), h, mu, reach_in_widths * widest_, known);
  }

  /// Whether the series of the pencil are accurate enough at an exceptional point: without their last terms
  /// it is at the same place.
  bool is_certain(const ExceptionalPoint& point) const {
    const auto shorter = shortened(pencil());
    if (!shorter) return true;
    const double same = search_.log.thresholds.event.same_veering * search_.frame().range.length();
    const double reach = reach_in_widths * widest_;
    const auto other = find_exceptional_point(*shorter, chart(), point.h, point.mu, reach, {});
    return other && std::abs(other->h - point.h) * std::abs(search_.frame().speed(*node_)) <= same;
  }

  /// Adds the veering of an exceptional point, if it is one and certain. False if it is of other modes.
  bool keep(const ExceptionalPoint& point) {
    const double speed = search_.frame().speed(*node_);
    Event event;
    event.kind = EventKind::veering;
    event.p = node_->p + point.h.real() * speed;
    event.half_width = std::abs(point.h.imag() * speed);
    const double t = (position_ + point.h.real()) / step_.h;
    const double beyond = std::max(beyond_the_step, std::abs(point.h.imag() / step_.h));
    const bool here = t > -beyond && t < 1.0 + beyond && search_.log.is_on_range(event);
    const bool counts = std::abs(point.h.imag()) <= widest_ &&
                        event.half_width >= narrowest * search_.frame().range.length() &&
                        0.5 * std::abs(point.next - point.h) > double_root * std::abs(point.h.imag());
    if (!here || !counts || !is_certain(point)) return true;
    const auto below = eigenvalues_below(pencil(), chart(), point);
    if (!below) return true;
    event.modes = modes_of(*below, t);
    if (event.modes.size() != 2) return true;
    const bool is_own = event.modes == modes_;
    event.s = chart_value(0.5 * ((*below)[0].mu + (*below)[1].mu), chart());
    if (event.s.imag() < 0.0) event.s = std::conj(event.s);
    event.node = search_.node;
    if (search_.log.has(event)) return is_own;
    const ComplexMatrix shape = node_->basis.shapes((*below)[0].z, track().pair.part);
    keep_shape(*node_, track().pair.part, shape.col(0), event);
    keep_sensitivities_of_mean(*below, t, event);
    found_.events.push_back(std::move(event));
    return is_own;
  }

  /// The derivatives of the mean of both eigenvalues, as one block at the real axis. The place is complex:
  /// what moves it is not known.
  void keep_sensitivities_of_mean(const std::array<EigenvalueBelow, 2>& below, double t, Event& event) const {
    const PathProblem& problem = search_.problem();
    InvariantPair pair;
    pair.chart = chart();
    pair.part = track().pair.part;
    pair.Lambda = Eigen::Vector2cd(below[0].mu, below[1].mu).asDiagonal();
    ComplexMatrix z(below[0].z.size(), 2);
    z << below[0].z, below[1].z;
    pair.Z = node_->basis.shapes(z, pair.part);
    const auto [node, distance] = from_nearer_end(t * step_.h);
    Prediction prediction = search_.solver.predict({node, {}}, distance);
    prediction.pairs = {std::move(pair)};
    const auto there = search_.solver.solve(prediction, node.basis.T[0]);
    if (!there) return leave_unknown(problem, event);
    keep_sensitivities(problem, there->point, there->node, there->node.tracks.front(), {0, 1}, {}, event,
                       search_.solver.counts());
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
    const auto [nearer, distance] = from_nearer_end(t * step_.h);
    const auto there = search_.solver.follow(one_track(nearer, seen.track), distance);
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
  FoundEvents& found_;
  PathProblem highest_ = search_.problem();  ///< with series of the highest order
  double position_ = 0.0;                    ///< of the point, as a distance from the left end
  std::optional<PathNode> node_;
};

/// The modes of both eigenvalue branches of a predicted meeting.
std::vector<int> modes_of(const PathNode& node, const ExpectedMeeting& expected) {
  std::vector<int> modes;
  for (const EigenvalueBranch* branch : {&expected.a, &expected.b}) {
    for (const int i : branch->members)
      modes.push_back(node.tracks[branch->track].modes[static_cast<std::size_t>(i)]);
  }
  return sorted_modes(modes);
}

}  // namespace

FoundEvents find_veerings(const EventSearch& search, const Step& step) {
  const double speed = search.frame().speed(*step.left);
  const double widest = search_width(search, *step.left);
  FoundEvents found;
  EventLog log = search.log;
  log.found = &found;
  const EventSearch own{search.solver, search.options, search.criteria, log, search.node};
  for (const ExpectedMeeting& expected : expected_beside(*step.left, step.right, step.h, widest)) {
    const std::vector<int> modes = modes_of(*step.left, expected);
    const Complex p(step.left->p + expected.position.real() * speed, expected.position.imag() * speed);
    if (modes.size() < 2 || log.knows_veering(p, modes)) continue;
    VeeringSearch(own, step, expected, modes, widest, found).run();
  }
  return found;
}

}  // namespace eigentrail
