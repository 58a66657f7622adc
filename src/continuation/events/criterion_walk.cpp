#include "continuation/events/criterion_walk.hpp"

#include <algorithm>

#include "continuation/events/event_record.hpp"
#include "continuation/events/nearby_mode.hpp"
#include "continuation/events/static_points.hpp"
#include "continuation/events/walk.hpp"
#include "continuation/step/shared_basis.hpp"
#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

using Sought = CriterionTarget::Sought;

/// Shares of the range: accuracy to which zeros and extrema are located. Extrema are less accurate, since the
/// function changes with the square of the distance from them.
constexpr double zero_resolution = 1e-12;
constexpr double extremum_resolution = 1e-10;
/// In steps: how far outside the step an iterate may lie, and a zero. Zeros farther outside belong to other
/// steps, which find them.
constexpr double way_outside = 0.5;
constexpr double end_outside = 0.05;
/// As a share of the last move of the eigenvalue: eigenvalues of the block that are closer than this coincide
/// at the place that is located.
constexpr double meeting_gap = 1e-7;
/// |Im s| / |s| up to this is rounding of a double real eigenvalue: the pair meets on the real axis.
constexpr double on_real_axis = 1e-6;
/// Newton's method for a root of a series: largest number of corrections, of which a simple root takes about
/// five, and relative size of the last one, at the level of rounding.
constexpr int most_corrections = 20;
constexpr double last_correction = 1e-15;

/// Whether a zero can be located as that of a product of two eigenvalues of a block.
bool has_product(const CriterionTarget& target, const Track& track) {
  return target.criterion.kind == EventKind::flutter && !target.pair &&
         target.sought == CriterionTarget::Sought::zero && track.pair.is_real && track.size() > 1;
}

Vector derivative(const Vector& series) {
  Vector result(series.size() - 1);
  for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = static_cast<double>(k + 1) * series[k + 1];
  return result;
}

/// The root of a power series to which Newton's method converges from zero.
struct RootOfSeries {
  double offset = 0.0;
  double doubt = INFINITY;  ///< change of the root by the last term: estimated truncation error
};

RootOfSeries root_near_zero(const Vector& series) {
  RootOfSeries root;
  for (int i = 0; i < most_corrections; ++i) {
    const auto [value, slope, curvature] = jet(series, root.offset);
    if (slope == 0.0 || !std::isfinite(value / slope)) return {};
    const double move = value / slope;
    root.offset -= move;
    if (std::abs(move) > last_correction * std::abs(root.offset) && i + 1 < most_corrections) continue;
    const auto last = static_cast<double>(series.size() - 1);
    root.doubt = std::abs(series[series.size() - 1] * std::pow(root.offset, last) / slope);
    break;
  }
  return root;
}

int sign_of(double x) {
  return x > 0.0 ? 1 : x < 0.0 ? -1 : 0;
}

/// `own`: the member that is meant where several are as near.
int nearest_member(const Track& track, Complex root, std::size_t own) {
  const Vector distances = (track.roots.array() - root).abs();
  Eigen::Index nearest = 0;
  const double least = distances.minCoeff(&nearest);
  const auto index = static_cast<Eigen::Index>(own);
  return static_cast<int>(index < distances.size() && distances[index] <= least ? index : nearest);
}

/// Locates one zero or extremum.
class CriterionWalk {
 public:
  /// `by_product`: of a real eigenvalue of a block, by the zero of a product (ModeFunction).
  CriterionWalk(const EventSearch& search, CriteriaOnStep& on_step, std::size_t member,
                const CriterionTarget& target, bool by_product, FoundEvents& found)
      : search_(search),
        on_step_(on_step),
        member_(member),
        target_(target),
        by_product_(by_product),
        found_(found),
        step_(on_step.step()) {}

  /// As `locate`.
  bool run(double t) {
    const auto look_from = [this](double distance) { return look(distance); };
    const Walk found = walk(t * step_.h, {.free_moves = 0}, look_from);
    if (found.end == WalkEnd::absent) {
      if (ending_ == Ending::at_meeting) record(0.0, false);
      return ending_ != Ending::unsettled;
    }
    if (found.end != WalkEnd::settled) return false;
    const double share = (found.position + found.move) / step_.h;
    const bool outside = !(share > -end_outside && share <= 1.0 + end_outside);
    if (target_.sought == Sought::zero && outside) return true;
    finish(found.move, found.position);
    return true;
  }

 private:
  /// Why a look ends the walk before Newton's method converges. at_meeting: the zero of Re s is at a double
  /// eigenvalue and is recorded there. unsettled: a real eigenvalue meets another one; its product with it
  /// will tell. passed: there is no event.
  enum class Ending { none, at_meeting, unsettled, passed };

  /// One Newton step from a distance from the left end.
  Sight look(double distance) {
    ++looks_;
    const Complex expected = on_step_.member_near(member_, distance / step_.h);
    const bool of_pair = target_.criterion.kind == EventKind::flutter && target_.pair;
    mode_ = look_at_mode(search_.solver, *step_.left, on_step_.track_index(), expected, distance,
                         by_product_ ? ModeFunction::product
                         : of_pair   ? ModeFunction::pair_mean
                                     : ModeFunction::eigenvalue);
    if (!mode_) return {Sight::Kind::failed};
    const ComplexVector& series = mode_->series;
    ending_ = ending(series, looks_);
    if (ending_ != Ending::none) return {Sight::Kind::absent};
    g_ = by_product_ ? Vector(series.real())
                     : criterion_series(target_.criterion, series, chart(),
                                        excitation_at(search_, mode_->solved.node));
    const bool is_zero = target_.sought == Sought::zero;
    // A slope this small is rounding: the mode stays on the axis and does not cross it.
    const double scale = std::max(std::abs(mode_->root), search_.problem().reference(chart()));
    const double still = rounding_of_mean() / scale * std::abs(series[1]);
    if (!g_.allFinite() || (is_zero ? std::abs(g_[1]) <= still : g_[1] == 0.0)) {
      ending_ = Ending::passed;
      return {Sight::Kind::absent};
    }
    const RootOfSeries root = root_near_zero(is_zero ? g_ : derivative(g_));
    const bool useful = root.doubt < INFINITY && std::abs(root.offset) <= std::abs(step_.h);
    const double newton = useful ? root.offset : is_zero ? -g_[0] / g_[1] : -0.5 * g_[1] / g_[2];
    const std::optional<double> behind_meeting = move_behind_meeting(distance, newton);
    const double move = behind_meeting.value_or(newton);
    moved_ = std::abs(series[1] * move);
    const double share = (distance + move) / step_.h;
    if (!(share > -way_outside && share < 1.0 + way_outside)) return {Sight::Kind::failed};
    // A move this short is accurate enough also for a zero: the error after a Newton step is about the square
    // of the move. Not so beside a meeting on the real axis, which may be as close.
    const double range = search_.frame().coordinate_range();
    const double resolution = (is_zero ? zero_resolution : extremum_resolution) * range;
    const bool beside_meeting = has_product(target_, track());
    const double short_move = beside_meeting ? resolution : extremum_resolution * range;
    const bool settled =
        !behind_meeting && ((useful && root.doubt <= resolution) || std::abs(move) <= short_move);
    return {settled ? Sight::Kind::settled : Sight::Kind::seen, move};
  }

  /// Whether the walk has reached a double eigenvalue, and what that means.
  Ending ending(const ComplexVector& series, int look) const {
    const bool of_axis = target_.criterion.kind == EventKind::flutter;
    const bool on_axis = std::abs(mode_->root.real()) <= rounding();
    // On the axis rounding tells eigenvalues from each other no better than from it.
    const double coincident = std::max(meeting_gap * moved_, of_axis && on_axis ? rounding() : 0.0);
    const bool meets = series.size() < 2 || (!by_product_ && mode_->gap <= coincident);
    if (!meets) return Ending::none;
    if (has_product(target_, track())) return Ending::unsettled;
    // A double eigenvalue has no derivatives, so that Newton's method cannot go on. Of a zero the signs on
    // both sides are known; that Re s may touch zero shows nothing where rounding hides it.
    const bool changes_sign = target_.sought == Sought::zero;
    return of_axis && changes_sign && (look > 1 || on_axis) ? Ending::at_meeting : Ending::passed;
  }

  /// Replaces Newton's move where eigenvalues coincide at the left end of the step and that move would lead
  /// past it. Beside such a point the criterion varies like g = g_m + c sqrt(d), d being the distance from
  /// the left end; the move leads to the zero of this function. Empty where it does not apply: also where g
  /// has the same sign at the left end as at the present iterate.
  std::optional<double> move_behind_meeting(double distance, double move) const {
    const bool overshoots = distance * step_.h > 0.0 && (distance + move) * step_.h <= 0.0;
    if (!track().departure || mode_->is_mean || by_product_ || target_.sought != Sought::zero || !overshoots)
      return std::nullopt;
    const Complex root = track().roots[static_cast<Eigen::Index>(member_)];
    const double at_meeting = on_step_.value(target_.criterion, upper_member(root, chart()), 0.0);
    if (at_meeting * g_[0] >= 0.0) return std::nullopt;
    const double share = at_meeting / (g_[0] - at_meeting);
    return (share * share - 1.0) * distance;
  }

  /// Decides whether the zero or extremum at `distance` + `offset` is an event, and records it. Beside an
  /// extremum near zero it locates the two zeros.
  void finish(double offset, double distance) {
    if (target_.sought == Sought::zero) return record(offset, true);
    const double value = jet(g_, offset)[0];
    const double curvature = 2.0 * g_[2];
    const double change = std::abs(curvature) * step_.h * step_.h / 8.0;  // over half a step
    if (target_.sought == Sought::extremum) {
      // Where a pair meets on the real axis its damping ratio is 1 or -1, an extremum of no interest.
      const bool oscillates = std::abs(mode_->root.imag()) > on_real_axis * std::abs(mode_->root);
      const bool matters = change > search_.thresholds().criterion.extremum * search_.options.tolerance;
      if (oscillates && matters) record(offset, true);
      return;
    }
    if (std::abs(value) <= rounding()) {
      if (change > rounding()) record(offset, true);
    } else if (value * curvature < 0.0) {
      const double half = std::sqrt(-2.0 * value / curvature);
      for (const double side : {-half, half}) {
        locate(search_, on_step_, member_, {target_.criterion, target_.pair, Sought::zero},
               (distance + offset + side) / step_.h, found_);
      }
    }
  }

  /// Records the event at the distance `offset` from the last look. `located`: Newton's method converged
  /// there; else it is a zero at a double eigenvalue.
  void record(double offset, bool located) {
    const PathNode& node = mode_->solved.node;
    const Track& there = node.tracks.front();
    const EventKind asked = target_.criterion.kind;
    const bool moves_on = located && !by_product_;
    const Complex root =
        moves_on ? evaluate_series(ComplexMatrix(mode_->series.transpose()), offset)[0] : mode_->root;
    Event event;
    event.kind = asked != EventKind::flutter || target_.pair ? asked : EventKind::divergence;
    event.p = evaluate_series(node.path.parameters, offset)[search_.problem().traced];
    event.s = chart_value(root, there.pair.chart);
    if (event.kind == EventKind::flutter) event.s = Complex(0.0, std::abs(event.s.imag()));
    if (event.kind == EventKind::divergence) event.s = 0.0;
    event.modes = {track().modes[member_]};
    event.retrackings = looks_;
    event.node = search_.node;
    if (asked == EventKind::extremum) event.value = -event.s.real() / std::abs(event.s);
    if (asked != EventKind::extremum && asked != EventKind::flutter) event.value = target_.criterion.value;
    const double speed = search_.frame().speed(node);
    event.direction = located ? direction(offset) : sign_of(target_.behind * step_.h * speed);
    // A zero of Re s at a recorded collision on the imaginary axis is that collision, not a second event. A
    // real eigenvalue 1/s that passes zero is at infinity: no divergence.
    if (asked == EventKind::flutter && search_.log.has_collision_at(event, located, search_.problem().s_ref))
      return;
    if (event.kind == EventKind::divergence && there.pair.chart == Chart::reciprocal) return;
    const std::vector<int> members{nearest_member(there, mode_->root, member_)};
    keep_shape(node, there, members, offset, event);
    const auto moves = [&](const Track&, const PathNode& along, const Track& along_q) {
      const bool is_zero = located && target_.sought == Sought::zero;
      return is_zero ? -slope_in(along, along_q, members) / g_[1] : NAN;
    };
    keep_sensitivities(search_.problem(), mode_->solved.point, node, there, members, moves, event,
                       search_.solver.counts());
    append(as_static_event(search_, node, std::move(event)), found_);
  }

  int direction(double offset) const {
    const double slope = jet(g_, offset)[1];
    switch (target_.sought) {
      case Sought::zero:
        // Where one of two factors is zero, the product's slope is that of the factor times the other one.
        return sign_of(slope * other_factor() * search_.frame().speed(mode_->solved.node));
      case Sought::extremum:
        return -sign_of(g_[2]);  // least damping is where Re mu / |mu| is largest
      default:
        return 0;
    }
  }

  /// Of a zero of a product: the other eigenvalue, which is the sum of both there. Else 1.
  double other_factor() const {
    if (!by_product_ || mode_->is_mean) return 1.0;
    const Track& there = mode_->solved.node.tracks.front();
    const int root = nearest_member(there, mode_->root, member_);
    return (there.roots[root] + there.roots[partner_of_root(there, root)]).real();
  }

  /// Derivative with respect to q of the function whose zero is located: `along_q` has its series in q.
  double slope_in(const PathNode& along, const Track& along_q, const std::vector<int>& members) const {
    const Track& there = mode_->solved.node.tracks.front();
    if (by_product_) {
      const std::vector<int> factors{members.front(), partner_of_root(there, members.front())};
      const auto part = part_series(along_q.series.Lambda, roots_of(there, factors));
      if (part.size() < 2) return NAN;
      return (mode_->is_mean ? mean_series(part) : product_series(part))[1].real();
    }
    const Complex slope = mean_slope(along_q, roots_of(there, members));
    const Vector excitation = excitation_at(search_, along).head(2);
    return criterion_series(target_.criterion, ComplexVector{{mode_->root, slope}}, there.pair.chart,
                            excitation)[1];
  }

  const Track& track() const { return on_step_.track(); }
  Chart chart() const { return track().pair.chart; }

  /// Errors by rounding of the eigenvalue at the last look, and of the mean of its block.
  double rounding() const {
    const Track& there = mode_->solved.node.tracks.front();
    const Vector errors = rounding_of_roots(there, search_.thresholds().rounding);
    return errors[nearest_member(there, mode_->root, member_)];
  }

  double rounding_of_mean() const {
    return search_.thresholds().rounding.entries * mode_->solved.node.tracks.front().pair.rounding;
  }

  const EventSearch& search_;
  CriteriaOnStep& on_step_;
  std::size_t member_;
  const CriterionTarget& target_;
  bool by_product_;
  FoundEvents& found_;
  const Step& step_;
  std::optional<NearbyMode> mode_;  ///< at the last look
  Vector g_;                        ///< series of the criterion there
  double moved_ = 0.0;              ///< change of the eigenvalue by the last move
  int looks_ = 0;
  Ending ending_ = Ending::none;
};

}  // namespace

CriteriaOnStep::CriteriaOnStep(const Step& step, std::size_t track, const HermiteInterpolant& excitation,
                               const RoundingThresholds& thresholds)
    : step_(step),
      index_(track),
      thresholds_(thresholds),
      roots_(*step.left, step.right, track, step.h),
      excitation_(excitation) {
  departing_roots(this->track(), step.h, departing_);
  begin_ = std::max(departing_, 0.0);
}

Complex CriteriaOnStep::member_near(std::size_t member, double t) {
  return roots_(std::clamp(t, departing_, 1.0))[static_cast<Eigen::Index>(member)];
}

Complex CriteriaOnStep::root(std::size_t member, double t) {
  return upper_member(roots_(t)[static_cast<Eigen::Index>(member)], track().pair.chart);
}

double CriteriaOnStep::value(const Criterion& criterion, Complex root, double t) const {
  const bool is_excited = criterion.kind == EventKind::resonance;
  return criterion_value(criterion, root, track().pair.chart, is_excited ? excitation_(t)[0].real() : 0.0);
}

double CriteriaOnStep::value(const Criterion& criterion, std::size_t member, double t) {
  return value(criterion, root(member, t), t);
}

double CriteriaOnStep::rounding(std::size_t member, double t) {
  if (t != rounding_at_) {
    roundings_ = rounding_of_roots(track(), roots_.functions()(t), roots_(t), thresholds_);
    rounding_at_ = t;
  }
  return roundings_[static_cast<Eigen::Index>(member)];
}

Vector excitation_at(const EventSearch& search, const PathNode& node) {
  const PathProblem& problem = search.problem();
  return excitation_series(search.options.events, problem.model.description().parameters,
                           node.path.parameters, problem.order + 1);
}

bool locate(const EventSearch& search, CriteriaOnStep& on_step, std::size_t member,
            const CriterionTarget& target, double t, FoundEvents& found) {
  const auto located = [&](bool by_product) {
    return CriterionWalk(search, on_step, member, target, by_product, found).run(t);
  };
  return located(false) || (has_product(target, on_step.track()) && located(true));
}

}  // namespace eigentrail
