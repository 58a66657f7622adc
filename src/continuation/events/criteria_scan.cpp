#include "continuation/events/criteria_scan.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "core/bisection.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Intervals between samples of a step. The dense output of one mode is a polynomial of degree 2 order + 1,
/// at most 9, so that each of its extrema has about three intervals. Eigenvalues of blocks are not
/// polynomials and can vary faster near an exceptional point. With fewer samples two zeros can lie between
/// two of them.
constexpr int samples_per_step = 24;
/// Bisections that locate a change of sign, and an extremum, on the dense output. The result only starts
/// Newton's method.
constexpr int sign_halvings = 30;
constexpr int extremum_halvings = 20;
/// In t: half the distance of the two values whose difference gives the sign of the slope near an extremum.
/// Much shorter than the distance of samples, but long enough that rounding does not decide the sign.
constexpr double slope_width = 1e-3;
/// In t: distance of the last sample from the right end where eigenvalues coincide there. At the end itself
/// they are known to the square root of rounding only.
constexpr double before_meeting = 1e-7;

/// Place of the extremum between one interval before t = about and one after it.
double extremum_near(CriteriaOnStep& on_step, const Criterion& criterion, std::size_t member, double about) {
  const auto slope = [&](double t) {
    return on_step.value(criterion, member, std::min(t + slope_width, 1.0)) -
           on_step.value(criterion, member, std::max(t - slope_width, on_step.begin()));
  };
  const double from = std::max(on_step.begin(), about - 1.0 / samples_per_step);
  const double to = std::min(1.0, about + 1.0 / samples_per_step);
  const double behind = slope(to);
  return bisected(from, to, extremum_halvings, [&](double t) { return !(slope(t) * behind > 0.0); }).middle();
}

/// Samples the eigenvalues of one track.
class TrackScan {
 public:
  TrackScan(const EventSearch& search, const Step& step, std::size_t track,
            const HermiteInterpolant& excitation, CriterionHistories& histories, FoundEvents& found)
      : search_(search),
        step_(step),
        index_(track),
        on_step_(step, track, excitation, search.thresholds().rounding),
        histories_(histories),
        found_(found) {}

  void run() {
    const double end = step_.right.tracks[index_].departure ? 1.0 - before_meeting : 1.0;
    double last = on_step_.begin();
    for (int k = 0; k <= samples_per_step; ++k) {
      const double t = std::max(on_step_.begin(), end * k / samples_per_step);
      if (k > 0 && t <= last) continue;
      for (std::size_t member = 0; member < track().modes.size(); ++member) {
        if (track().modes[member] >= 0) look(member, last, t);
      }
      last = t;
    }
    if (step_.right.tracks[index_].departure) look_at_meeting(last);
  }

 private:
  using Seen = CriterionHistory::Seen;
  using Sought = CriterionTarget::Sought;

  /// A place on the step at which criteria are evaluated.
  struct Sample {
    double last, t;        ///< the place before it, and its own
    bool of_mean = false;  ///< the eigenvalue is the mean of some that meet there
  };

  const Track& track() const { return step_.left->tracks[index_]; }

  /// Evaluates all criteria of a mode at the sample t; `last` is the sample before it.
  void look(std::size_t member, double last, double t) {
    const Complex s = on_step_.root(member, t);
    const bool is_pair = s.imag() != 0.0;
    for (std::size_t c = 0; c < search_.criteria.size(); ++c) {
      CriterionHistory& history = histories_[{track().modes[member], c}];
      // The value at the left end is known from the last step, unless the mode begins there.
      if (t <= last && history.is_known()) continue;
      if (search_.criteria[c].asks_for_pairs() && !is_pair) {
        history = {};
        continue;
      }
      take(search_.criteria[c], history, member, s, {last, t});
    }
  }

  /// Real eigenvalues that meet at the right end are known there only to a root of rounding, but their mean
  /// is known. So a zero between the last sample and the end is seen.
  void look_at_meeting(double last) {
    const Track& end = step_.right.tracks[index_];
    const auto nearest_met = [&](int i) {
      std::vector<int> others = end.met;
      std::erase(others, i);
      const auto nearest =
          std::ranges::min_element(others, {}, [&](int j) { return std::abs(end.roots[j] - end.roots[i]); });
      return end.roots[nearest == others.end() ? i : *nearest];
    };
    for (const int i : end.met) {
      const auto member = static_cast<std::size_t>(i);
      if (track().modes[member] < 0 || on_step_.root(member, last).imag() != 0.0) continue;
      const double mean = 0.5 * (end.roots[i] + nearest_met(i)).real();
      for (std::size_t c = 0; c < search_.criteria.size(); ++c) {
        CriterionHistory& history = histories_[{track().modes[member], c}];
        if (!search_.criteria[c].asks_for_pairs())
          take(search_.criteria[c], history, member, mean, {last, 1.0, true});
      }
    }
  }

  /// Compares a criterion at the sample t with the samples before, and locates the zero or extremum that
  /// they show.
  void take(const Criterion& criterion, CriterionHistory& history, std::size_t member, Complex s,
            const Sample& at) {
    const double size = std::max(std::abs(s), search_.problem().reference(track().pair.chart));
    const double value = on_step_.value(criterion, s, at.t);
    // The sign of a value this small, as of Re s of an undamped mode, is rounding.
    const auto rounding = [&] {
      return at.of_mean ? search_.thresholds().rounding.entries * track().pair.rounding
                        : on_step_.rounding(member, at.t);
    };
    if (!criterion.asks_for_extrema() && std::abs(value) <= rounding()) {
      // Where real eigenvalues have met at zero and left it as a pair, their sign does not count any more:
      // the collision says what ended.
      if (!history.is_pair() && std::abs(s.imag()) > rounding()) history = {};
      history.skip();
      return;
    }
    const double before = history.value();
    const bool pair = s.imag() != 0.0 && history.is_pair();
    const Seen seen = history.next(value);
    history.is_pair(s.imag() != 0.0);
    // Where eigenvalues coincide at the left end the criterion may have a kink there, which is no extremum.
    if (seen == Seen::extremum && track().departure && at.last <= on_step_.begin()) return;
    if (seen == Seen::zero && !criterion.asks_for_extrema()) {
      const double guess = bisected(at.last, at.t, sign_halvings, [&](double t) {
                             return on_step_.value(criterion, member, t) * before > 0.0;
                           }).middle();
      if (!locate_at(member, {criterion, pair, Sought::zero, value}, guess) && !criterion.asks_for_pairs())
        note_unlocated(member, guess);
    } else if (seen == Seen::extremum && criterion.asks_for_extrema()) {
      if (is_told(history)) locate_extremum(member, {criterion, pair, Sought::extremum}, at.last);
    } else if (seen == Seen::extremum && before * history.bend() > 0.0 && may_touch(history, before, size)) {
      locate_extremum(member, {criterion, pair, Sought::touch}, at.last);
    }
  }

  /// Whether an extremum is distinct from the error of the dense output: a parabola with its second
  /// difference changes by more than the threshold over half a step.
  bool is_told(const CriterionHistory& history) const {
    // f''/2 (1/2)^2, where f'' is the second difference times samples_per_step^2.
    constexpr double half_a_step = 0.125 * samples_per_step * samples_per_step;
    return half_a_step * std::abs(history.bend()) >
           search_.thresholds().criterion.extremum * search_.options.tolerance;
  }

  /// Whether the function may have two zeros near an extremum at which the samples do not change sign.
  /// `before` is the sample next to the extremum.
  bool may_touch(const CriterionHistory& history, double before, double size) const {
    // Assumed error of the vertex of the parabola, as a share of its distance from the sample.
    constexpr double vertex_error = 0.5;
    const double doubt = search_.thresholds().criterion.near_axis * search_.options.tolerance * size +
                         vertex_error * std::abs(before - history.top());
    return history.top() * before <= 0.0 || std::abs(history.top()) <= doubt;
  }

  bool locate_at(std::size_t member, const CriterionTarget& target, double t) {
    return locate(search_, on_step_, member, target, t, found_);
  }
  void locate_extremum(std::size_t member, const CriterionTarget& target, double about) {
    locate_at(member, target, extremum_near(on_step_, target.criterion, member, about));
  }

  /// Adds a note for the user on a change of sign that Newton's method did not confirm. It is not an event.
  void note_unlocated(std::size_t member, double t) {
    const Vector parameters = evaluate_series(step_.left->path.parameters, t * step_.h);
    found_.notes.push_back("Re s of mode " + std::to_string(track().modes[member] + 1) +
                           " changes its sign near " +
                           place_text(search_.options, parameters[search_.problem().traced]) +
                           " on the dense output; the place could not be located");
  }

  const EventSearch& search_;
  const Step& step_;
  std::size_t index_;
  CriteriaOnStep on_step_;
  CriterionHistories& histories_;
  FoundEvents& found_;
};

}  // namespace

CriterionHistory::Seen CriterionHistory::next(double value) {
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

void inherit_histories(const std::vector<Birth>& births, const std::vector<Criterion>& criteria,
                       CriterionHistories& histories) {
  for (const Birth& birth : births) {
    for (std::size_t c = 0; c < criteria.size(); ++c) {
      if (!criteria[c].asks_for_pairs()) histories[{birth.born, c}] = histories[{birth.parent, c}];
    }
  }
}

void begin_histories(const PathProblem& problem, const PathNode& node, int first, double h,
                     const std::vector<Criterion>& criteria, CriterionHistories& histories) {
  for (const Track& track : node.tracks) {
    const ComplexVector before =
        in_order_of(track.roots, block_roots(evaluate_series(track.functions, -h / samples_per_step)));
    const Vector rounding = rounding_of_roots(track, problem.thresholds.rounding);
    for (Eigen::Index i = 0; i < track.size(); ++i) {
      const int mode = track.modes[static_cast<std::size_t>(i)];
      if (mode < first || !(std::abs(before[i].real()) > rounding[i])) continue;
      for (std::size_t c = 0; c < criteria.size(); ++c) {
        if (criteria[c].asks_for_pairs()) continue;
        CriterionHistory& history = histories[{mode, c}];
        history.next(before[i].real());
        history.is_pair(before[i].imag() != 0.0);
      }
    }
  }
}

FoundEvents scan_criteria(const EventSearch& search, const Step& step, CriterionHistories& histories) {
  const auto row = [&](const PathNode& node) -> ComplexMatrix {
    return excitation_at(search, node).cast<Complex>().transpose();
  };
  const HermiteInterpolant excitation(step.h, row(*step.left), row(step.right));
  FoundEvents found;
  for (std::size_t i = 0; i < step.left->tracks.size(); ++i)
    TrackScan(search, step, i, excitation, histories, found).run();
  return found;
}

}  // namespace eigentrail
