// Where eigenvalues cross the imaginary axis: flutter and divergence.
#include <algorithm>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/shared_basis.hpp"
#include "continuation/strands.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Real parts below this, relatively, are zero: an undamped system does not flutter by rounding.
constexpr double vanishing_damping = 1e-9;
constexpr int samples_per_step = 24;

}  // namespace

namespace {

/// Where the real part of an eigenvalue, of the sign of `before` at t = from, changes sign on the dense
/// output.
double sign_change(const DenseBlock& block, double length, ComplexVector roots, Eigen::Index member,
                   double from, double to, double before) {
  constexpr int halvings = 30;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (from + to);
    const ComplexVector there = follow_roots(block, length, roots, from, middle);
    if (there[member].real() * before > 0.0) {
      from = middle;
      roots = there;
    } else {
      to = middle;
    }
  }
  return 0.5 * (from + to);
}

}  // namespace

/// Real parts that change sign from one sample to the next, or from the last step to this one.
void Tracer::find_axis_crossings(double h, const PathNode& next) {
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& track = node_.tracks[i];
    const DenseBlock block = block_on_step(node_, next, i);
    double last = 0.0;
    ComplexVector roots = departing_roots(track, h, last);
    // Where eigenvalues coincide they are known to half their digits only.
    const double end = next.tracks[i].departure ? 1.0 - 1e-7 : 1.0;
    for (int k = 1; k <= samples_per_step; ++k) {
      const double t = end * k / samples_per_step;
      const ComplexVector roots_before = roots;
      roots = follow_roots(block, h, roots, last, t);
      for (Eigen::Index member = 0; member < track.size(); ++member) {
        const int mode = track.modes[static_cast<std::size_t>(member)];
        if (mode < 0) continue;
        const Complex s = roots[member];
        // Undamped modes stay on the axis but for rounding.
        if (std::abs(s.real()) <=
            vanishing_damping * std::max(std::abs(s), problem_.reference(track.pair.chart)))
          continue;
        const auto before = last_value_.find(mode);
        const bool crossed = before != last_value_.end() && before->second.real() * s.real() < 0.0;
        if (crossed) {
          const double a = before->second.real();
          const bool pair = before->second.imag() != 0.0 && s.imag() != 0.0;
          const double guess = sign_change(block, h, roots_before, member, last, t, a);
          locate_axis_crossing(h, next, i, static_cast<std::size_t>(member), guess, pair);
        }
        last_value_[mode] = s;
      }
      last = t;
    }
  }
}

/// Newton for Re s = 0 with the mode tracked anew at every guess.
void Tracer::locate_axis_crossing(double h, const PathNode& next, std::size_t index, std::size_t member,
                                  double t, bool pair) {
  const Track& track = node_.tracks[index];
  const DenseBlock block = block_on_step(node_, next, index);
  double from = 0.0;
  const ComplexVector start = departing_roots(track, h, from);
  const PathNode base = with_tracks(node_, {index});
  double distance = t * h;
  double last_move = 0.0;
  for (int i = 1; i <= most_retrackings; ++i) {
    const double position = std::clamp(distance / h, from, 1.0);
    const Complex expected = follow_roots(block, h, start, from, position)[static_cast<Eigen::Index>(member)];
    const std::optional<PathNode> point = probe(base, distance);
    if (!point) break;
    const Track& there = point->tracks.front();
    Eigen::Index nearest = 0;
    (there.roots.array() - expected).abs().minCoeff(&nearest);
    Complex s = there.roots[nearest];
    ComplexVector series = root_series(there.functions, s);
    if (const auto single = separate(problem_, *point, there, {static_cast<int>(nearest)}, result_.counts)) {
      s = single->roots[0] +
          eigenvalue_remainder(PencilAtPoint(point->pencil, single->pair.chart), single->pair);
      series = single->functions.row(0).transpose();
    }
    if (pair && there.pair.is_real && there.size() == 2) {
      // The real part of a conjugate pair is its mean, smooth also where the pair is defective.
      series = mean_series(there.series.Lambda);
      s.real(series[0].real());
    }
    const bool meets =
        series.size() < 2 || (there.roots.size() > 1 && least_gap(there.roots) <= 1e-7 * last_move);
    const bool at_zero = std::abs(s.real()) <= 1e-6 * problem_.reference(track.pair.chart);
    if (meets && (i > 1 || at_zero)) {
      // Newton has led to a double root, where derivatives of one eigenvalue end.
      record_axis_crossing(*point, 0.0, s, index, member, pair, i);
      break;
    }
    // A mode that stays on the axis crosses it by rounding only.
    if (series.size() < 2 || std::abs(series[1].real()) <= vanishing_damping * std::abs(series[1])) break;
    const double move = -s.real() / series[1].real();
    distance += move;
    last_move = std::abs(series[1] * move);
    if (distance / h < -0.5 || distance / h > 1.5) break;
    const bool on_step = distance / h > -1e-4 && distance / h <= 1.0 + 1e-4;
    // One correction more squares what is left.
    if (std::abs(move) > 1e-10 * coordinate_range() && i < most_retrackings) continue;
    if (!on_step) break;
    record_axis_crossing(*point, move, s + series[1] * move, index, member, pair, i);
    break;
  }
}

void Tracer::record_axis_crossing(const PathNode& point, double offset, Complex s, std::size_t index,
                                  std::size_t member, bool pair, int retrackings) {
  const Track& track = node_.tracks[index];
  Event event;
  event.kind = pair ? EventKind::flutter : EventKind::divergence;
  event.p = point.p + offset * coefficient(point.path.parameters, problem_.traced, 1);
  event.s = pair ? chart_value(Complex(0.0, std::abs(s.imag())), track.pair.chart) : Complex(0.0);
  event.modes = {track.modes[member]};
  event.retrackings = retrackings;
  event.node = result_.nodes;
  // Modes that coalesce leave the imaginary axis, or pass it, at their meeting: one point, one event. In the
  // reciprocal chart zero is infinity.
  const bool met = std::any_of(result_.events.begin(), result_.events.end(), [&](const Event& other) {
    // Around a triple one the roots are known to the cube root of the error only.
    const double near = (other.modes.size() > 2 ? 1e-4 : 1e-6) * range();
    return other.kind == EventKind::collision && (!pair || other.modes.size() > 1) &&
           std::abs(other.p - event.p) <= near;
  });
  if (!met && (pair || track.pair.chart == Chart::finite)) add_static_event(point, std::move(event));
}

}  // namespace eigentrail
