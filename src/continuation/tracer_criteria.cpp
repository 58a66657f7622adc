// Zeros and extrema of functions of single eigenvalues: flutter, divergence, damping ratios, resonances.
#include <algorithm>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/shared_basis.hpp"
#include "continuation/strands.hpp"
#include "continuation/tracer.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// Values below this, relatively, are zero: an undamped system does not flutter by rounding.
constexpr double vanishing = 1e-9;
constexpr int samples_per_step = 24;

/// A polynomial's root nearest to zero as Newton's method finds it, and how far its last term moves it.
struct RootOfSeries {
  double offset = 0.0;
  double doubt = INFINITY;
};

RootOfSeries root_near_zero(const Vector& series) {
  constexpr int corrections = 20;
  RootOfSeries root;
  for (int i = 0; i < corrections; ++i) {
    double value = 0.0;
    double slope = 0.0;
    for (Eigen::Index k = series.size() - 1; k >= 0; --k) {
      slope = slope * root.offset + value;
      value = value * root.offset + series[k];
    }
    if (slope == 0.0 || !std::isfinite(value / slope)) return {};
    const double move = value / slope;
    root.offset -= move;
    if (std::abs(move) > 1e-15 * std::abs(root.offset) && i + 1 < corrections) continue;
    const auto last = static_cast<double>(series.size() - 1);
    root.doubt = std::abs(series[series.size() - 1] * std::pow(root.offset, last) / slope);
    break;
  }
  return root;
}

Vector derivative(const Vector& series) {
  Vector result(series.size() - 1);
  for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = static_cast<double>(k + 1) * series[k + 1];
  return result;
}

Complex upper(Complex s, Chart chart) {
  const bool lower = chart == Chart::finite ? s.imag() < 0.0 : s.imag() > 0.0;
  return lower ? std::conj(s) : s;
}

}  // namespace

/// A criterion's values for one mode, sample by sample.
Tracer::Watch::Seen Tracer::Watch::next(double value) {
  const double change = known_ ? value - value_ : 0.0;
  Seen seen = Seen::nothing;
  if (known_ && value_ * value < 0.0) {
    seen = Seen::zero;
  } else if (known_ && (skipped_ || change_ * change < 0.0)) {
    seen = Seen::extremum;
    bend_ = skipped_ ? value : change - change_;
    top_ = skipped_ ? 0.0 : value_ - std::pow(change + change_, 2) / (8.0 * bend_);
  }
  change_ = change;
  value_ = value;
  known_ = true;
  skipped_ = false;
  return seen;
}

/// The criteria of one eigenvalue on a step.
class Tracer::StepCriteria {
 public:
  StepCriteria(const PathNode& left, const PathNode& next, std::size_t track, double h,
               const HermiteInterpolant& excitation)
      : track_(left.tracks[track]), roots_(left, next, track, h), excitation_(excitation) {
    departing_roots(track_, h, begin_);
  }

  double begin() const { return std::max(begin_, 0.0); }
  /// The root of the track's chart at t, moved into the step.
  Complex member_near(std::size_t member, double t) {
    return roots_(std::clamp(t, begin_, 1.0))[static_cast<Eigen::Index>(member)];
  }
  Complex root(std::size_t member, double t) {
    return upper(roots_(t)[static_cast<Eigen::Index>(member)], track_.pair.chart);
  }
  double value(const Criterion& criterion, Complex root, double t) const {
    const bool is_excited = criterion.kind == EventKind::resonance;
    return criterion_value(criterion, root, track_.pair.chart, is_excited ? excitation_(t)[0].real() : 0.0);
  }
  double value(const Criterion& criterion, std::size_t member, double t) {
    return value(criterion, root(member, t), t);
  }
  /// What rounding leaves of a value: of eigenvalues that coincide at the left end it is half their digits.
  double noise() const {
    if (track_.size() == 1) return 0.0;
    const double level = 10.0 * std::sqrt(function_rounding(track_.pair.Lambda).maxCoeff());
    return least_gap(track_.roots) <= level ? level : 0.0;
  }
  /// Where the value, of the sign of `before` at t = from, changes sign.
  double sign_change(const Criterion& criterion, std::size_t member, double from, double to, double before) {
    constexpr int halvings = 30;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (from + to);
      (value(criterion, member, middle) * before > 0.0 ? from : to) = middle;
    }
    return 0.5 * (from + to);
  }
  /// Where the value has its extremum, between one sample before `about` and one behind it.
  double extremum(const Criterion& criterion, std::size_t member, double about) {
    constexpr int halvings = 20;
    constexpr double small = 1e-3;
    const auto slope = [&](double t) {
      return value(criterion, member, std::min(t + small, 1.0)) -
             value(criterion, member, std::max(t - small, begin()));
    };
    double from = std::max(begin(), about - 1.0 / samples_per_step);
    double to = std::min(1.0, about + 1.0 / samples_per_step);
    const double behind = slope(to);
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (from + to);
      (slope(middle) * behind > 0.0 ? to : from) = middle;
    }
    return 0.5 * (from + to);
  }

 private:
  const Track& track_;
  StrandSampler roots_;
  const HermiteInterpolant& excitation_;
  double begin_ = 0.0;
};

Vector Tracer::excitation(const PathNode& node) const {
  return excitation_series(options_.events, problem_.model.description().parameters, node.path.parameters,
                           problem_.order + 1);
}

void Tracer::find_zeros(double h, const PathNode& next) {
  const HermiteInterpolant frequency(h, excitation(node_).cast<Complex>().transpose(),
                                     excitation(next).cast<Complex>().transpose());
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& track = node_.tracks[i];
    StepCriteria step(node_, next, i, h, frequency);
    // Where eigenvalues coincide they are known to half their digits only.
    const double end = next.tracks[i].departure ? 1.0 - 1e-7 : 1.0;
    double last = step.begin();
    for (int k = 0; k <= samples_per_step; ++k) {
      const double t = std::max(step.begin(), end * k / samples_per_step);
      if (k > 0 && t <= last) continue;
      for (std::size_t member = 0; member < track.modes.size(); ++member) {
        if (track.modes[member] >= 0) watch(h, {i, member}, step, last, t);
      }
      last = t;
    }
  }
}

/// Looks at all criteria of a mode at one sample of the step, and for what lies between it and the last one.
void Tracer::watch(double h, const Member& member, StepCriteria& step, double last, double t) {
  const Track& track = node_.tracks[member.track];
  const int mode = track.modes[member.index];
  const Complex s = step.root(member.index, t);
  const double size = std::max(std::abs(s), problem_.reference(track.pair.chart));
  const bool is_pair = s.imag() != 0.0;
  for (std::size_t c = 0; c < criteria_.size(); ++c) {
    const Criterion& criterion = criteria_[c];
    Watch& watch = watches_[{mode, c}];
    // The end of the last step is known; a mode that is new is not.
    if (t <= last && watch.is_known()) continue;
    if (criterion.asks_for_pairs() && !is_pair) {
      watch = {};
      continue;
    }
    const double value = step.value(criterion, s, t);
    const double scale = criterion.asks_for_extrema() ? 1.0 : size;
    // Undamped modes stay on the axis but for rounding.
    if (!criterion.asks_for_extrema() && std::abs(value) <= std::max(vanishing * scale, step.noise())) {
      watch.skip();
      continue;
    }
    const double before = watch.value();
    const bool pair = is_pair && watch.is_pair();
    const Watch::Seen seen = watch.next(value);
    watch.is_pair(is_pair);
    // Where eigenvalues meet at the left end, what looks like an extremum is a kink.
    const bool is_kink = seen == Watch::Seen::extremum && track.departure && last <= step.begin();
    if (is_kink) continue;
    if (seen == Watch::Seen::zero && !criterion.asks_for_extrema()) {
      const double guess = step.sign_change(criterion, member.index, last, t, before);
      if (!locate(h, step, member, {criterion, pair, Sought::zero}, guess) && !criterion.asks_for_pairs())
        note_unlocated(mode, evaluate_series(node_.path.parameters, guess * h)[problem_.traced]);
    } else if (seen == Watch::Seen::extremum && criterion.asks_for_extrema()) {
      // Told from the error of the dense output by what it changes over half a step.
      constexpr double half_a_step = 0.125 * samples_per_step * samples_per_step;
      if (half_a_step * std::abs(watch.bend()) > options_.tolerance) {
        locate(h, step, member, {criterion, pair, Sought::extremum},
               step.extremum(criterion, member.index, last));
      }
    } else if (seen == Watch::Seen::extremum && before * watch.bend() > 0.0) {
      // A dip towards zero: two zeros may hide in it.
      constexpr double near = 10.0;
      const double doubt = near * options_.tolerance * size + 0.5 * std::abs(before - watch.top());
      if (watch.top() * before <= 0.0 || std::abs(watch.top()) <= doubt)
        locate(h, step, member, {criterion, pair, Sought::dip}, step.extremum(criterion, member.index, last));
    }
  }
}

/// A change of sign that Newton's method does not confirm is no event, but told.
void Tracer::note_unlocated(int mode, double p) {
  result_.notes.push_back("Re s of mode " + std::to_string(mode + 1) + " changes its sign near " +
                          at_parameter(p) + " on the dense output; the place could not be located");
}

/// One eigenvalue of a block without the others, where it is far enough from them to be found alone.
std::optional<Tracer::Probe> Tracer::probe_alone(Complex expected, std::size_t track, double distance) {
  constexpr double apart = 1e-3;  // of its size
  constexpr double nearer = 0.1;  // than the next one
  if (node_.tracks[track].size() == 1) return std::nullopt;
  Prediction prediction = predict(with_tracks(node_, {track}), distance);
  const ComplexVector roots = pair_eigenvalues(prediction.pairs.front());
  Eigen::Index nearest = 0;
  (roots.array() - expected).abs().minCoeff(&nearest);
  const Complex root = roots[nearest];
  double gap = INFINITY;
  for (Eigen::Index j = 0; j < roots.size(); ++j) {
    if (j != nearest) gap = std::min(gap, std::abs(roots[j] - root));
  }
  if (!(gap > apart * std::abs(root))) return std::nullopt;
  prediction.pairs.front() = part_of(prediction.pairs.front(), roots, {static_cast<int>(nearest)});
  std::optional<Probe> there = probe(prediction, node_.basis.T[0]);
  if (there && !(std::abs(there->node.tracks.front().roots[0] - root) <= nearer * gap)) there.reset();
  return there;
}

/// The eigenvalue of a member of a block as a series at a point near a step, and the point.
std::optional<Tracer::Closer> Tracer::look_closer(double h, StepCriteria& step, const Member& member,
                                                  const Aim& aim, double distance) {
  const Complex expected = step.member_near(member.index, distance / h);
  std::optional<Probe> beside = probe_alone(expected, member.track, distance);
  if (!beside) beside = probe(predict(with_tracks(node_, {member.track}), distance), node_.basis.T[0]);
  if (!beside) return std::nullopt;
  const Track& there = beside->node.tracks.front();
  const Chart chart = there.pair.chart;
  Eigen::Index nearest = 0;
  (there.roots.array() - expected).abs().minCoeff(&nearest);
  Complex s = there.roots[nearest];
  ComplexVector series = root_series(there.functions, s);
  if (const auto single =
          separate(problem_, beside->node, there, {static_cast<int>(nearest)}, result_.counts)) {
    series = single->functions.row(0).transpose();
    series[0] += eigenvalue_remainder(PencilAtPoint(beside->node.pencil, chart), single->pair);
    s = series[0];
  }
  if (aim.criterion.kind == EventKind::flutter && aim.pair && there.pair.is_real && there.size() == 2) {
    // The real part of a conjugate pair is its mean, smooth also where the pair is defective.
    series = mean_series(there.series.Lambda);
    s.real(series[0].real());
  }
  if (upper(s, chart) != s) {
    s = std::conj(s);
    series = series.conjugate().eval();
  }
  const double gap = there.roots.size() > 1 ? least_gap(there.roots) : INFINITY;
  return Closer{std::move(*beside), s, std::move(series), gap};
}

/// Newton's method for a zero or an extremum, on the series of the mode tracked anew at every guess. False
/// where it does not converge.
bool Tracer::locate(double h, StepCriteria& step, const Member& member, const Aim& aim, double t) {
  const double reference = problem_.reference(node_.tracks[member.track].pair.chart);
  const double resolution = (aim.sought == Sought::zero ? 1e-12 : 1e-10) * coordinate_range();
  double distance = t * h;
  double last_move = 0.0;
  double last_step = INFINITY;
  for (int i = 1; i <= most_retrackings; ++i) {
    const std::optional<Closer> closer = look_closer(h, step, member, aim, distance);
    if (!closer) return false;
    const ComplexVector& series = closer->series;
    const bool meets = series.size() < 2 || closer->gap <= 1e-7 * last_move;
    const bool on_axis = std::abs(closer->root.real()) <= 1e-6 * reference;
    if (meets && aim.criterion.kind == EventKind::flutter && (i > 1 || on_axis)) {
      // Newton has led to a double root, where derivatives of one eigenvalue end.
      record_zero(*closer, {}, 0.0, member, aim, i);
      return true;
    }
    if (meets) return true;
    const Vector g = criterion_series(aim.criterion, series, node_.tracks[member.track].pair.chart,
                                      excitation(closer->node));
    // A mode that stays on the axis crosses it by rounding only.
    if (!g.allFinite() || std::abs(g[1]) <= vanishing * std::abs(series[1]) * (aim.sought == Sought::zero))
      return true;
    const RootOfSeries root = root_near_zero(aim.sought == Sought::zero ? g : derivative(g));
    const bool useful = root.doubt < INFINITY && std::abs(root.offset) <= std::abs(h);
    const double move = useful ? root.offset : aim.sought == Sought::zero ? -g[0] / g[1] : -0.5 * g[1] / g[2];
    last_move = std::abs(series[1] * move);
    const double share = (distance + move) / h;
    if (!(share > -0.5 && share < 1.5)) return false;
    // One correction more would square what is left.
    const bool is_settled =
        (useful && root.doubt <= resolution) || std::abs(move) <= 1e-10 * coordinate_range();
    if (!is_settled) {
      if (std::abs(move) > 0.5 * last_step) return false;
      last_step = std::abs(move);
      distance += move;
      continue;
    }
    // What lies behind the last point was seen from there.
    constexpr double beside = 0.05;
    if (aim.sought == Sought::zero && !(share > -beside && share <= 1.0 + beside)) return true;
    finish(h, step, *closer, g, move, distance, member, aim, i);
    return true;
  }
  return false;
}

/// What a zero or an extremum that has been located means.
void Tracer::finish(double h, StepCriteria& step, const Closer& closer, const Vector& g, double offset,
                    double distance, const Member& member, const Aim& aim, int retrackings) {
  if (aim.sought == Sought::zero) return record_zero(closer, g, offset, member, aim, retrackings);
  double value = 0.0;
  for (Eigen::Index k = g.size() - 1; k >= 0; --k) value = value * offset + g[k];
  const double curvature = derivative(derivative(g))[0];
  if (aim.sought == Sought::extremum) {
    // Where a pair touches the real axis the damping ratio cannot be exceeded.
    const bool oscillates = std::abs(closer.root.imag()) > 1e-6 * std::abs(closer.root);
    const bool matters = oscillates && std::abs(curvature) * h * h / 8.0 > options_.tolerance;
    if (matters) record_zero(closer, g, offset, member, aim, retrackings);
    return;
  }
  const double scale = std::max(std::abs(closer.root), problem_.reference(closer.node.tracks[0].pair.chart));
  if (std::abs(value) <= vanishing * scale) {
    record_zero(closer, g, offset, member, aim, retrackings);
  } else if (value * curvature < 0.0) {
    const double half = std::sqrt(-2.0 * value / curvature);
    for (const double side : {-half, half})
      locate(h, step, member, {aim.criterion, aim.pair, Sought::zero}, (distance + offset + side) / h);
  }
}

}  // namespace eigentrail
