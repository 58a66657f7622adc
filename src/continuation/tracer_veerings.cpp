// Exceptional points beside the real parameter axis: two modes come close and part again.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// Exceptional points farther from the real axis than this share of the range are no veering.
constexpr double widest_veering = 0.01 * (1.0 + 1e-9);

/// Taylor coefficients of a smooth function at several points of the path's coordinate, and the polynomial
/// that shares them all, in Newton's form.
class PointwiseInterpolant {
 public:
  void add(double x, const ComplexVector& series) {
    for (Eigen::Index k = 0; k < series.size(); ++k) {
      x_.push_back(x);
      table_.push_back(series);
    }
    refresh();
  }
  bool empty() const { return x_.empty(); }

  Complex operator()(Complex x) const {
    Complex value = 0.0;
    for (std::size_t i = coefficients_.size(); i-- > 0;) value = value * (x - x_[i]) + coefficients_[i];
    return value;
  }
  /// What the last derivative that was added contributes at x, or the one before: about the error there.
  double last_contribution(Complex x) const {
    double product = 1.0;
    double last = 0.0;
    double before = 0.0;
    for (std::size_t i = 0; i < coefficients_.size(); ++i) {
      before = last;
      last = product * std::abs(coefficients_[i]);
      product *= std::abs(x - x_[i]);
    }
    return std::max(last, before);
  }

 private:
  /// Divided differences, confluent where points repeat.
  void refresh() {
    const std::size_t n = x_.size();
    std::vector<Complex> column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = table_[i][0];
    coefficients_ = {column[0]};
    for (std::size_t order = 1; order < n; ++order) {
      for (std::size_t i = 0; i + order < n; ++i) {
        column[i] = x_[i + order] == x_[i] ? table_[i][static_cast<Eigen::Index>(order)]
                                           : (column[i + 1] - column[i]) / (x_[i + order] - x_[i]);
      }
      coefficients_.push_back(column[0]);
    }
  }

  std::vector<double> x_;
  std::vector<ComplexVector> table_;
  std::vector<Complex> coefficients_;
};

/// Whether a series, too, has its root about where the interpolant has: its terms still fall there, and
/// cancel.
bool confirms_root(const ComplexVector& series, Complex root) {
  constexpr double share = 0.02;
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

/// Whether two eigenvalues that do not influence each other coincide at a complex parameter.
bool is_double_root(const PointwiseInterpolant& f, Complex root) {
  constexpr double share = 0.02;
  const double step = 0.1 * std::abs(root.imag());
  const Complex slope = (f(root + step) - f(root - step)) / (2.0 * step);
  const Complex curvature = (f(root + step) + f(root - step) - 2.0 * f(root)) / (step * step);
  return std::abs(slope) <= share * std::abs(curvature * root.imag());
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

/// Error of a root of the interpolant, as its last terms tell; infinite where the slope is not told.
double error_of_root(const PointwiseInterpolant& f, Complex root, double step) {
  const double slope = std::abs(f(root + step) - f(root - step)) / (2.0 * step);
  return slope > 0.0 ? f.last_contribution(root) / slope : INFINITY;
}

/// The gap as seen from both ends of a step of length h; an end next to where it is expected is left out,
/// since points will follow there.
PointwiseInterpolant gap_from_ends(const ExpectedMeeting& expected, double h) {
  constexpr double next_to = 0.02;  // of the step
  PointwiseInterpolant gap;
  const auto add = [&](double position, const ComplexVector& series) {
    const bool far = std::abs(position - expected.position.real()) > next_to * std::abs(h);
    if (series.size() > 0 && far) gap.add(position, series);
  };
  add(0.0, expected.gap_at_left);
  add(h, expected.gap_at_right);
  return gap;
}

}  // namespace

double Tracer::veering_width() const {
  const double speed = plane_ ? std::abs(coefficient(node_.path.parameters, problem_.traced, 1)) : 1.0;
  return std::min(widest_veering * range() / std::max(speed, 1e-3), 2.0 * range());
}

/// A point below an expected meeting, whose only track is the two strands as one block.
std::optional<PathNode> Tracer::as_one_block(double h, const PathNode& next,
                                             const ExpectedMeeting& expected) {
  const Strand& a = expected.a;
  const Strand& b = expected.b;
  const bool right = expected.position.real() / h > 0.5;
  const PathNode& nearer = right ? next : node_;
  const double distance = expected.position.real() - (right ? h : 0.0);
  if (a.track != b.track) {
    PathNode apart = with_tracks(nearer, {});
    for (const Strand* strand : {&a, &b}) {
      std::optional<Track> track =
          separate(problem_, nearer, nearer.tracks[strand->track], strand->members, result_.counts);
      if (!track) return std::nullopt;
      apart.tracks.push_back(std::move(*track));
    }
    return joined_at(apart, distance);
  }
  const PathNode base = with_tracks(nearer, {a.track});
  std::optional<PathNode> point = probe(base, distance);
  if (!point || has_jumped(base, point->tracks.front(), distance)) return std::nullopt;
  const std::vector<int> members = united(a.members, b.members);
  Track& block = point->tracks.front();
  if (static_cast<Eigen::Index>(members.size()) == block.size()) return point;
  // In a larger block the two are told from the others where they are close to each other.
  StrandSampler strands(node_, next, a.track, h);
  block.roots = in_order_of(strands(std::clamp(expected.position.real() / h, 0.0, 1.0)), block.roots);
  std::optional<Track> pair = separate(problem_, *point, block, members, result_.counts);
  if (!pair) return std::nullopt;
  point->tracks = {std::move(*pair)};
  return point;
}

/// The two tracks of a point as one block at a distance from it.
std::optional<PathNode> Tracer::joined_at(const PathNode& apart, double distance) {
  Prediction prediction = predict(apart, distance);
  const InvariantPair& a = prediction.pairs[0];
  const InvariantPair& b = prediction.pairs[1];
  InvariantPair joined = join_pairs({&a, &b}, a.is_real || b.is_real);
  // A real one beside a pair brings the conjugate along: these do not veer.
  if (joined.size() != a.size() + b.size()) return std::nullopt;
  prediction.pairs = {std::move(joined)};
  std::optional<Probe> there = probe(prediction, apart.basis.T[0]);
  if (!there || has_jumped(apart, there->node.tracks.front(), distance)) return std::nullopt;
  return std::move(there->node);
}

void Tracer::find_veerings(double h, const PathNode& next) {
  for (const ExpectedMeeting& expected : expected_beside(node_, next, h, veering_width())) {
    std::vector<int> modes;
    for (const Strand* strand : {&expected.a, &expected.b}) {
      for (const int i : strand->members)
        modes.push_back(node_.tracks[strand->track].modes[static_cast<std::size_t>(i)]);
    }
    modes = sorted_modes(modes);
    if (modes.size() < 2 || is_known_veering(expected.position, modes)) continue;
    if (const auto below = as_one_block(h, next, expected)) record_veering(*below, h, expected, modes);
  }
}

bool Tracer::is_known_veering(Complex position, const std::vector<int>& modes) const {
  constexpr double alike = 0.01;
  const double speed = coefficient(node_.path.parameters, problem_.traced, 1);
  const double p = node_.p + position.real() * speed;
  const double half_width = std::abs(position.imag() * speed);
  const auto is_it = [&](const Event& event) {
    const double slack = alike * event.half_width + 1e-6 * range();
    return event.modes == modes && std::abs(event.p - p) <= slack &&
           std::abs(event.half_width - half_width) <= slack;
  };
  return std::any_of(result_.events.begin(), result_.events.end(), is_it) ||
         std::any_of(no_veerings_.begin(), no_veerings_.end(), is_it);
}

/// A block that has jumped to other modes is not the one that began: its trace does not fit the series.
bool Tracer::has_jumped(const PathNode& from, const Track& to, double distance) const {
  const auto trace_of = [](const Track& track) -> ComplexVector {
    return static_cast<double>(track.size()) * mean_series(track.series.Lambda);
  };
  ComplexVector trace = trace_of(from.tracks.front());
  for (std::size_t i = 1; i < from.tracks.size(); ++i) trace += trace_of(from.tracks[i]);
  const Complex expected = evaluate_series(ComplexMatrix(trace.transpose()), distance)[0];
  const Eigen::Index last = trace.size() - 1;
  const double step = std::abs(distance);
  if (step == 0.0) return false;
  // One of the last terms alone may happen to be small.
  const double uncertain = std::pow(step, static_cast<double>(last)) *
                           std::max(std::abs(trace[last]), std::abs(trace[last - 1]) / step);
  const double drift = std::abs(trace_of(to)[0] - expected);
  return drift > 10.0 * uncertain + 1e-6 * std::max(std::abs(expected), problem_.s_ref);
}

/// The exceptional point of two modes beside the real axis. `base` holds them as one block, below the place
/// where it is expected. This point and the series at both ends of the step tell a near one; a farther one is
/// told by points around it.
void Tracer::record_veering(const PathNode& base, double h, const ExpectedMeeting& expected,
                            const std::vector<int>& modes) {
  constexpr int rounds = 6;
  const double speed = std::abs(coefficient(base.path.parameters, problem_.traced, 1));
  const double widest = 2.0 * widest_veering * range() / speed;
  const double resolution = 1e-10 * range() / speed;
  const auto gap_there = [&](const PathNode& node) {
    return gap_series(node.tracks.front().series.Lambda,
                      static_cast<Eigen::Index>(expected.a.members.size()));
  };
  Event event;
  std::optional<PathNode> below;
  PointwiseInterpolant gap;
  Complex root = expected.position;
  double position = 0.0;
  const double at = expected.position.real();
  const auto look = [&](double where, PointwiseInterpolant& function) {
    position = where;
    below = where == at ? base : probe(base, where - at);
    ++event.retrackings;
    if (!below || has_jumped(base, below->tracks.front(), where - at)) return false;
    function.add(where, gap_there(*below));
    return true;
  };
  bool is_settled = false;
  double last_move = INFINITY;
  for (int round = 0; round < rounds && !is_settled; ++round) {
    const double width = std::max(std::abs(root.imag()), 1e-6 * widest);
    PointwiseInterpolant around;
    const auto look_beside = [&](double offset) {
      return look(root.real() + offset, around) || look(root.real() + 0.5 * offset, around);
    };
    const bool seen = round > 0 && look_beside(-width) && look_beside(width);
    gap = seen ? around : gap_from_ends(expected, h);
    if (!look(root.real(), gap)) return;
    const Complex refined = secant(gap, root, width);
    const double move = std::abs(refined - root);
    if (!(std::abs(refined.imag()) < widest && move < 3.0 * widest)) return;
    const double error = error_of_root(gap, refined, resolution);
    // Another way to one that is recorded, or one that is too wide.
    if (is_known_veering(refined, modes)) return;
    if (std::abs(refined.imag()) - error > 0.5 * widest) return;
    // Settled, or no longer getting nearer at the level of rounding.
    const bool narrow = std::abs(refined.imag()) <= 100.0 * resolution;
    const bool nears = move <= 0.5 * last_move;
    is_settled =
        move <= resolution || (!narrow && error <= resolution) || (!nears && move <= 100.0 * resolution);
    if (!is_settled && !nears && round > 1) return;
    last_move = move;
    root = refined;
  }
  if (!is_settled) return;
  const double offset = root.real() - position;
  const double speed_there = coefficient(below->path.parameters, problem_.traced, 1);
  event.kind = EventKind::veering;
  event.half_width = std::abs(root.imag() * speed_there);
  event.p = below->p + offset * speed_there;
  const Track& there = below->tracks.front();
  event.s =
      chart_value(evaluate_series(ComplexMatrix(mean_series(there.series.Lambda).transpose()), offset)[0],
                  there.pair.chart);
  event.modes = modes;
  event.node = result_.nodes;
  // Another exceptional point as near as this one spoils the series: then nothing can be told.
  const bool is_told = !is_double_root(gap, root) && confirms_root(gap_there(*below), root - position);
  const bool is_wide = event.half_width > widest_veering * range();
  const bool counts = is_told && !is_wide && event.half_width >= resolution;
  if (!counts) {
    no_veerings_.push_back(std::move(event));
    return;
  }
  std::vector<int> members(there.modes.size());
  std::iota(members.begin(), members.end(), 0);
  keep_shape(*below, 0, members, offset, event);
  const auto stays = [](const Track&, const PathNode&, const Track&) {
    return std::numeric_limits<double>::quiet_NaN();  // the point itself is complex
  };
  keep_sensitivities(solved_point(*below), *below, 0, members, stays, event);
  add_event(std::move(event));
}

}  // namespace eigentrail
