#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/shared_basis.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Exceptional points farther from the real axis than this share of the range are no veering.
constexpr double widest_veering = 0.01 * (1.0 + 1e-9);
/// Multiple roots of an interpolant may lie this share of the step off the axis.
constexpr double looked_into = 0.2;
constexpr double narrow = 1e-3;  ///< of a step: veerings up to this half-width get a point of their own

}  // namespace

double Tracer::veering_width() const {
  const double speed = plane_ ? std::abs(coefficient(node_.path.parameters, problem_.traced, 1)) : 1.0;
  return std::min(widest_veering * range() / std::max(speed, 1e-3), 2.0 * range());
}

/// The trace may begin on a special point.
void Tracer::record_meetings_at_start() {
  const double glimpse = direction_ * 1e-6 * range();
  for (std::size_t i = 0; i < node_.tracks.size(); ++i) {
    Track& track = node_.tracks[i];
    if (track.size() < 2) continue;
    const Meeting meeting = meeting_at(node_, i, 0.05 * range());
    if (!meeting.found || std::abs(meeting.offset) > 1e-10 * range()) continue;
    record_meeting(node_, i, meeting, 0);
    excluded_ = 1e-6;
    if (meeting.kind == EventKind::veering) continue;
    track.departure = Track::Departure{glimpse, block_roots(evaluate_series(track.functions, glimpse))};
    if (track.pair.is_real) settle_real_block(track);
    track.arriving = track.modes;
  }
}

/// The meeting nearest to a point. Two members of a larger block that lie apart from the others are looked at
/// by themselves: their own discriminant is told to full accuracy.
Meeting Tracer::meeting_at(const PathNode& point, std::size_t index, double reach) {
  const Track& track = point.tracks[index];
  Meeting meeting = nearest_meeting(track, reach);
  if (!meeting.found || track.size() < 3 || meeting.members.size() != 2) return meeting;
  const std::optional<Track> pair = separate(problem_, point, track, meeting.members, result_.counts);
  if (!pair) return meeting;
  Meeting closer = nearest_meeting(*pair, reach);
  if (!closer.found) return meeting;
  closer.members = meeting.members;
  return closer;
}

/// A veering that is wide for the step needs no point of its own.
void Tracer::look_beside(const PathNode& point, std::size_t index, const Meeting& meeting) {
  const Track& track = point.tracks[index];
  std::vector<int> modes;
  for (const int i : meeting.members) modes.push_back(track.modes[static_cast<std::size_t>(i)]);
  modes = sorted_modes(modes);
  // A pair that comes near the real axis and turns back is no veering of two modes.
  if (modes.size() != 2) return;
  PathNode base = with_tracks(point, {index});
  if (track.size() > 2) {
    std::optional<Track> pair = separate(problem_, point, track, meeting.members, result_.counts);
    if (!pair) return;
    base.tracks = {std::move(*pair)};
  }
  record_veering(base, meeting.root, modes);
}

/// Follows a meeting to where it lies, by its offset as seen from ever nearer points. When it is reached on
/// the step, `h` and `next` are the step that ends there.
Tracer::Approach Tracer::approach_meeting(const ExpectedMeeting& expected, double excluded, double& h,
                                          std::optional<PathNode>& next, Meeting& meeting, int& retrackings) {
  const double end = h;
  const double resolution = plane_ ? settled : settled * std::max(range(), std::abs(node_.p));
  std::optional<PathNode> point = next;
  double distance = std::abs(expected.distance) < std::abs(end) ? expected.distance : end;
  double last_move = INFINITY;
  for (; retrackings < most_retrackings; ++retrackings) {
    if (distance == end) {
      point = next;
    } else if (attempt(distance, point)) {
      return Approach::failed;
    }
    const bool pair = point->tracks[expected.track].size() == 2;
    meeting =
        meeting_at(*point, expected.track, pair ? std::max(std::abs(end), 2.0 * veering_width()) : 0.5 * end);
    if (!meeting.found) return Approach::nothing;
    const double move = std::abs(meeting.offset);
    if (meeting.kind == EventKind::veering && meeting.half_width > narrow * std::abs(end) &&
        (move < 0.1 * std::abs(end) || retrackings > 0)) {
      look_beside(*point, expected.track, meeting);
      return Approach::nothing;
    }
    // Settled, or no longer getting nearer at the level of rounding.
    if (move <= resolution || (move > 0.5 * last_move && move <= 1e-7 * std::abs(end))) {
      h = distance;
      next = std::move(point);
      return Approach::reached;
    }
    last_move = move;
    distance += meeting.offset;
    const double share = distance / end;
    if (!(share > excluded && share <= 1.0 + 1e-9)) {
      return move < 0.3 * std::abs(end) || retrackings > 1 ? Approach::nothing : Approach::failed;
    }
    if (share > 1.0) distance = end;
  }
  return Approach::failed;
}

/// Other blocks may meet at the very point where the step now ends.
void Tracer::find_simultaneous_meetings(double h, const PathNode& next, std::vector<Meeting>& meetings) {
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    if (meetings[i].found || next.tracks[i].size() < 2) continue;
    const Meeting meeting = meeting_at(next, i, 0.5 * h);
    const double here = 1e-10 * (plane_ ? 1.0 : range());
    if (!meeting.found || std::abs(meeting.offset) > here || meeting.half_width > narrow * std::abs(h))
      continue;
    meetings[i] = meeting;
    record_meeting(next, i, meeting, 1);
  }
}

bool Tracer::land_on_meeting(double& h, std::optional<PathNode>& next) {
  const StageTimer timer(result_.counts.events_seconds);
  const EventWork work(result_.counts);
  std::vector<Meeting> meetings(next->tracks.size());
  const double excluded = excluded_;
  excluded_ = 0.0;
  for (const ExpectedMeeting& expected :
       expected_meetings(node_, *next, h, veering_width() + looked_into * std::abs(h))) {
    Meeting meeting;
    int retrackings = 0;
    const Approach approach = approach_meeting(expected, excluded, h, next, meeting, retrackings);
    if (approach == Approach::failed && std::abs(h) > uncertified_below_) {
      excluded_ = excluded;
      return false;
    }
    if (approach != Approach::reached) continue;
    meetings[expected.track] = meeting;
    record_meeting(*next, expected.track, meeting, retrackings);
    excluded_ = 1e-6;
    break;
  }
  if (excluded_ > 0.0) find_simultaneous_meetings(h, *next, meetings);
  label_departure(h, *next, meetings);
  return true;
}

void Tracer::record_meeting(const PathNode& node, std::size_t index, const Meeting& meeting,
                            int retrackings) {
  const Track& track = node.tracks[index];
  std::vector<int> modes;
  for (const int i : meeting.members) {
    const int mode = track.modes[static_cast<std::size_t>(i)];
    if (mode >= 0) modes.push_back(mode);
  }
  modes = sorted_modes(modes);
  if (modes.empty()) return;
  // One mode alone: a pair and its conjugate. They touch the real axis, or merely come near it.
  const bool pair = modes.size() == 1 && track.pair.is_real;
  if (pair && meeting.kind == EventKind::veering) return;
  // Eigenvalues that meet at infinity, where the mass is singular, are no coincidence of modes.
  if (track.pair.chart == Chart::reciprocal && std::abs(track.roots.mean()) * problem_.s_max <= 1.0) return;
  Event event;
  event.kind = meeting.kind;
  const double speed = coefficient(node.path.parameters, problem_.traced, 1);
  event.p = node.p + meeting.offset * speed;
  Complex mean = 0.0;
  for (const int i : meeting.members) mean += track.roots[i];
  event.s = chart_value(mean / static_cast<double>(meeting.members.size()), track.pair.chart);
  if (event.s.imag() < 0.0) event.s = std::conj(event.s);
  if (track.pair.is_real && pair) event.s = event.s.real();
  event.modes = modes;
  if (event.kind == EventKind::veering) event.half_width = std::abs(speed) * meeting.half_width;
  if (event.kind == EventKind::collision) {
    const double exponent = 1.0 / static_cast<double>(meeting.members.size());
    event.puiseux = meeting.puiseux / std::pow(Complex(speed), exponent);
    if (track.pair.chart == Chart::reciprocal) event.puiseux *= -event.s * event.s;
  }
  event.retrackings = retrackings;
  event.node = result_.nodes;
  add_static_event(node, std::move(event));
}

/// The tracks of `base` followed to a distance from it.
std::optional<PathNode> Tracer::probe(const PathNode& base, double h) {
  const PathPoint point = compute_point(problem_, predict(base, h), base.basis.T[0], result_.counts);
  if (point.status != PointStatus::computed) return std::nullopt;
  return differentiate_point(problem_, point, result_.counts);
}

namespace {

/// Taylor coefficients of a smooth function at several points of the path's coordinate, and the polynomial
/// that shares them all, in Newton's form.
class PointwiseInterpolant {
 public:
  void add(double x, const ComplexVector& series) {
    for (Eigen::Index k = 0; k < series.size(); ++k) {
      x_.push_back(x);
      table_.push_back(series);
    }
  }
  /// Divided differences, confluent where points repeat.
  void finish() {
    const std::size_t n = x_.size();
    std::vector<Complex> column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = table_[i][0];
    coefficients_.push_back(column[0]);
    for (std::size_t order = 1; order < n; ++order) {
      for (std::size_t i = 0; i + order < n; ++i) {
        column[i] = x_[i + order] == x_[i] ? table_[i][static_cast<Eigen::Index>(order)]
                                           : (column[i + 1] - column[i]) / (x_[i + order] - x_[i]);
      }
      coefficients_.push_back(column[0]);
    }
  }
  Complex operator()(Complex x) const {
    Complex value = 0.0;
    for (std::size_t i = coefficients_.size(); i-- > 0;) value = value * (x - x_[i]) + coefficients_[i];
    return value;
  }

 private:
  std::vector<double> x_;
  std::vector<ComplexVector> table_;
  std::vector<Complex> coefficients_;
};

/// Whether a series, too, has its root about where the interpolant has: its terms still fall there, and
/// cancel.
bool confirms_root(const ComplexVector& series, Complex root) {
  constexpr double share = 0.1;
  double largest = 0.0;
  Complex term = 0.0;
  Complex sum = 0.0;
  Complex power = 1.0;
  for (const Complex coefficient : series) {
    term = coefficient * power;
    sum += term;
    largest = std::max(largest, std::abs(term));
    power *= root;
  }
  return std::abs(term) <= share * largest && std::abs(sum) <= share * largest;
}

Complex secant(const PointwiseInterpolant& f, Complex root, double width) {
  Complex a = root + 1e-3 * width;
  Complex fa = f(a);
  for (int i = 0; i < 30; ++i) {
    const Complex fr = f(root);
    if (fr == fa) break;
    const Complex next = root - fr * (root - a) / (fr - fa);
    a = root;
    fa = fr;
    root = next;
    if (std::abs(root - a) <= 1e-15 * width) break;
  }
  return root;
}

}  // namespace

/// Two modes whose exceptional point lies beside the real axis. `base` holds them as one block; `root` is
/// where the point is expected, relative to it. The series at one point tells a near root well and a farther
/// one poorly: points around it make it an interpolation.
void Tracer::record_veering(const PathNode& base, Complex root, const std::vector<int>& modes) {
  constexpr int rounds = 5;
  const double speed = std::abs(coefficient(base.path.parameters, problem_.traced, 1));
  const double widest = 2.0 * widest_veering * range() / speed;
  const double resolution = 1e-10 * range() / speed;
  int retrackings = 0;
  std::optional<PathNode> middle;
  double last_position = 0.0;
  bool settled_there = false;
  for (int round = 0; round < rounds && !settled_there; ++round) {
    const double width = std::max(std::abs(root.imag()), 1e-6 * widest);
    PointwiseInterpolant delta;
    for (const double offset : {-1.0, 1.0, 0.0}) {
      const double x = root.real() + offset * width;
      middle = probe(base, x);
      last_position = x;
      ++retrackings;
      if (!middle) return;
      delta.add(x, middle->tracks[0].functions.row(1).transpose());
    }
    delta.finish();
    // A block that has jumped to other modes is not the one that began: its mean does not fit the series.
    const double far = std::abs(root.real());
    const Complex mean = evaluate_series(base.tracks[0].functions, root.real())[0];
    const double curvature = std::abs(base.tracks[0].functions(0, base.tracks[0].functions.cols() - 1)) *
                             std::pow(far, static_cast<double>(base.tracks[0].functions.cols() - 1));
    const double drift = std::abs(middle->tracks[0].functions(0, 0) - mean);
    if (drift > 10.0 * curvature + 1e-6 * std::max(std::abs(mean), problem_.s_ref)) return;
    const Complex refined = secant(delta, root, width);
    if (!(std::abs(refined.imag()) < widest && std::abs(refined - root) < 3.0 * widest)) return;
    settled_there = std::abs(refined - root) <= resolution;
    root = refined;
  }
  // Another exceptional point as near as this one spoils the series: then nothing can be told.
  if (!middle || !confirms_root(middle->tracks[0].functions.row(1).transpose(), root - last_position)) return;
  const double speed_there = coefficient(middle->path.parameters, problem_.traced, 1);
  Event event;
  event.kind = EventKind::veering;
  event.half_width = std::abs(root.imag() * speed_there);
  if (!settled_there || event.half_width > widest_veering * range() || event.half_width < resolution) return;
  event.p = middle->p + (root.real() - last_position) * speed_there;
  event.s = chart_value(middle->tracks[0].functions(0, 0), middle->tracks[0].pair.chart);
  event.modes = modes;
  event.retrackings = retrackings;
  event.node = result_.nodes;
  add_event(std::move(event));
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

void Tracer::find_events(double h, const PathNode& next) {
  const StageTimer timer(result_.counts.events_seconds);
  const EventWork work(result_.counts);
  find_axis_crossings(h, next);
  find_distant_veerings(h, next);
  record_branch_point(next);
  find_folds(h, next);
}

/// Two single modes with an exceptional point beside the step, expected at t.
void Tracer::record_distant_veering(double h, const PathNode& next, std::size_t i, std::size_t j, Complex t) {
  const bool right = t.real() > 0.5;
  const PathNode& nearer = right ? next : node_;
  PathNode base = with_tracks(nearer, {i, j});
  const std::vector<int> modes = sorted_modes({nearer.tracks[i].modes[0], nearer.tracks[j].modes[0]});
  const Complex root = (right ? t - 1.0 : t) * h;
  const double estimate = nearer.p + root.real() * coefficient(nearer.path.parameters, problem_.traced, 1);
  const bool known = std::any_of(result_.events.begin(), result_.events.end(), [&](const Event& event) {
    return event.modes == modes &&
           std::abs(event.p - estimate) <= 0.5 * std::abs(root.imag()) + 1e-6 * range();
  });
  if (known) return;
  if (join(problem_, base, 0, {{false, 1, 0.0}}, result_.counts)) record_veering(base, root, modes);
}

/// Exceptional points of modes that pass each other as single ones.
void Tracer::find_distant_veerings(double h, const PathNode& next) {
  const double width = veering_width();
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& a = next.tracks[i];
    if (a.size() > 1) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const Track& b = next.tracks[j];
      if (b.size() > 1 || a.pair.chart != b.pair.chart || a.pair.is_real != b.pair.is_real) continue;
      // Far apart at both ends for what they move: nothing between.
      const auto near = [&](const PathNode& node) {
        const ComplexVector difference =
            (node.tracks[i].functions.row(0) - node.tracks[j].functions.row(0)).transpose();
        double others = 0.0;
        double power = 1.0;
        for (Eigen::Index k = 1; k < difference.size(); ++k)
          others += std::abs(difference[k]) * (power *= std::abs(h) + width);
        return std::abs(difference[0]) < 2.0 * others;
      };
      if (!near(node_) && !near(next)) continue;
      const auto delta_series = [&](const PathNode& node) {
        const ComplexVector half =
            0.5 * (node.tracks[i].functions.row(0) - node.tracks[j].functions.row(0)).transpose();
        return ComplexMatrix(multiply_series(half, half).transpose());
      };
      const HermiteInterpolant delta(h, delta_series(node_), delta_series(next));
      const int degree = 2 * static_cast<int>(a.functions.cols()) - 1;
      for (const Complex t : roots_near_unit_interval([&](double u) { return delta(u)[0]; }, degree)) {
        // Estimates: what lies outside is left out when it is located.
        if (t.real() <= -0.1 || t.real() > 1.1 || std::abs(t.imag() * h) > 1.1 * width) continue;
        record_distant_veering(h, next, i, j, t);
      }
    }
  }
}

}  // namespace eigentrail
