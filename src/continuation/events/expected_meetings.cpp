#include "continuation/events/expected_meetings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "continuation/events/common_collision.hpp"
#include "continuation/events/meeting_resolution.hpp"
#include "continuation/events/roots_on_step.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// In steps: largest distance from the real axis of a root of a gap that can be a meeting on the axis.
constexpr double looked_into = 0.1;

/// Whether a mode, and not only a conjugate or a guard mode, is among the eigenvalues of the branch.
bool stands_for_a_mode(const Track& track, const EigenvalueBranch& branch) {
  return std::any_of(branch.members.begin(), branch.members.end(),
                     [&](int i) { return track.modes[static_cast<std::size_t>(i)] >= 0; });
}

/// Whether both eigenvalues take part in a meeting at the left end, so that their gap has a known root there.
bool have_just_met(const Track& track, const std::vector<int>& a, const std::vector<int>& b) {
  return contains(track.met, a.front()) && contains(track.met, b.front());
}

/// Adds a position unless the list has one within this share of it: the two roots into which a double root
/// splits are one place.
void add_position(double position, std::vector<double>& found) {
  constexpr double share = 1e-3;
  const auto is_there = [&](double other) {
    return std::abs(other - position) <= share * std::abs(position);
  };
  if (std::none_of(found.begin(), found.end(), is_there)) found.push_back(position);
}

/// The stretch of a step on which rounding does not hide two eigenvalues of a track: not beside a meeting of
/// many at either end in which both take part.
Stretch where_told_apart(const Track& left, const Track& right, double length, const EigenvalueBranch& a,
                         const EigenvalueBranch& b) {
  Stretch stretch;
  if (have_just_met(left, a.members, b.members)) stretch.from = left.hidden_within / std::abs(length);
  if (have_just_met(right, a.members, b.members)) stretch.to = 1.0 - right.hidden_within / std::abs(length);
  return stretch;
}

/// Where all eigenvalues of a track collide on a step; empty where they do not. What they do at the left end
/// is known.
std::optional<PlaceOnStep> common_place(const Track& track, const EigenvalueSampler& sampler) {
  // In steps: nearer to the left end it is the known one.
  constexpr double behind_a_meeting = 1e-3;
  const double lambda = rounding_of(track, track.series.Lambda).lambda;
  const double behind = track.hidden_within > 0.0 ? behind_a_meeting : 0.0;
  for (const PlaceOnStep& place : common_collisions_on_step(sampler.functions(), lambda)) {
    if (place.t > behind) return place;
  }
  return std::nullopt;
}

ExpectedMeeting expected_of_all(const Track& track, std::size_t index, double position) {
  ExpectedMeeting meeting{{index, other_members(track.size(), {})}, {index, {}}, position};
  meeting.is_of_all = true;
  return meeting;
}

/// Series of an eigenvalue branch at one end, the mean of all that coincide. Empty when these cannot be
/// separated from the others of the block.
ComplexVector series_of(const Track& track, const EigenvalueBranch& branch) {
  if (track.size() == 1) return track.functions.row(0).transpose();
  const std::vector<ComplexMatrix> part = part_series(track.series.Lambda, roots_of(track, branch.members));
  return part.empty() ? ComplexVector() : mean_series(part);
}

/// An eigenvalue branch with its series at both ends of the step.
struct BranchSeries {
  EigenvalueBranch branch;
  ComplexVector left, right;
};

/// Whether the gap of two eigenvalue branches is no power series at an end of a step, because one of them
/// meets another eigenvalue of its block there: it varies like a root.
bool is_singular_at(const PathNode& node, const EigenvalueBranch& a, const EigenvalueBranch& b) {
  for (const EigenvalueBranch* branch : {&a, &b}) {
    const std::vector<int>& met = node.tracks[branch->track].met;
    const std::vector<int> own = a.track == b.track ? united(a.members, b.members) : branch->members;
    const auto is_own = [&](int i) { return contains(own, i); };
    if (std::any_of(met.begin(), met.end(), is_own) && !std::all_of(met.begin(), met.end(), is_own))
      return true;
  }
  return false;
}

/// Series of the gap of two eigenvalue branches at one end, from their own series there; empty when it is not
/// known.
ComplexVector gap_at(const PathNode& node, const EigenvalueBranch& a, const ComplexVector& series_a,
                     const EigenvalueBranch& b, const ComplexVector& series_b) {
  if (is_singular_at(node, a, b)) return {};
  if (a.track == b.track) return discriminant_of(node.tracks[a.track], a.members, b.members);
  if (series_a.size() == 0 || series_b.size() == 0) return {};
  return discriminant_series(series_a, series_b);
}

/// A root of an interpolant is not accepted where the last term is a larger share of the largest one: there
/// the interpolant does not represent the function.
constexpr double told_by_series = 0.05;

/// In steps: veerings up to this far beyond the ends of the step are located from it.
constexpr double off_the_ends = 0.1;
/// The same for the left end, for a root that is `off_axis` steps off the axis. Predictions far off the axis
/// of a short step are inaccurate; the next, longer step finds such a veering behind its left end.
double behind_the_step(double off_axis) {
  constexpr double share_of_height = 0.2;
  return std::max(off_the_ends, share_of_height * off_axis);
}

/// Whether a gap, by its series at an end of a step, certainly has no root up to `width` off the axis from a
/// little before the step to a little behind it.
bool stays_away(const ComplexVector& gap, double length, double width) {
  return gap.size() > 0 && has_no_root_within(gap, (1.0 + off_the_ends) * std::abs(length) + 2.0 * width);
}

/// Region in which roots up to `off_axis` (in steps) off the axis are wanted, in shares of the step and
/// enlarged by `margin_of_region`.
Rectangle surroundings(double off_axis) {
  const double from = -behind_the_step(off_axis) - margin_of_region;
  const double to = 1.0 + off_the_ends + margin_of_region;
  return {0.5 * (from + to), 0.5 * (to - from), off_axis + margin_of_region};
}

/// Distance up to which the last term of a series is at most the share `told_by_series` of the largest one.
double told_within(const ComplexVector& series) {
  const Eigen::Index last = series.size() - 1;
  double distance = 0.0;
  for (Eigen::Index k = 0; k < last; ++k)
    distance = std::max(distance, std::pow(told_by_series * std::abs(series[k] / series[last]),
                                           1.0 / static_cast<double>(last - k)));
  return distance;
}

/// Roots of the gap near a step, as distances from its left end: from the interpolant of the series at both
/// ends, or from one series where only that is known.
std::vector<Complex> gap_roots(const ComplexVector& left, const ComplexVector& right, double length,
                               double width) {
  if (left.size() == 0 && right.size() == 0) return {};
  if (left.size() == 0 || right.size() == 0) {
    const ComplexVector& gap = left.size() == 0 ? right : left;
    const double told = told_within(gap);
    if (stays_away(gap, length, width) || has_no_root_within(gap, told)) return {};
    std::vector<Complex> roots = polynomial_roots(gap);
    std::erase_if(roots, [&](Complex root) { return std::abs(root) > told; });
    for (Complex& root : roots) root += left.size() == 0 ? length : 0.0;
    return roots;
  }
  const HermiteInterpolant gap(length, left.transpose(), right.transpose());
  const double widest = (1.0 + told_by_series) * width / std::abs(length);
  Rectangle step = surroundings(widest);
  const double middle = std::exchange(step.center, 0.0).real();
  const ComplexVector series = gap.series(middle, gap.degree()).row(0).transpose();
  if (has_no_root_in(series, step)) return {};
  std::vector<Complex> roots = polynomial_roots(series);
  for (Complex& root : roots) root += middle;
  std::erase_if(roots, [&](Complex t) {
    const double share = gap.last_share(0, t);
    return share > told_by_series || std::abs(t.imag() * length) > (1.0 + share) * width;
  });
  for (Complex& root : roots) root *= length;
  return roots;
}

struct RoughRoot {
  Complex position;
  Complex gap_below;  ///< of the parabola at the real part of its root
};

/// The roots of the parabolas that agree with the gap at either end, as distances from the left end. Where
/// other eigenvalues are as close, no interpolant of the gap is accurate, but a parabola tells that these two
/// come close, and about where.
std::vector<RoughRoot> rough_roots(const ComplexVector& left, const ComplexVector& right, double length) {
  std::vector<RoughRoot> roots;
  for (const ComplexVector* gap : {&left, &right}) {
    if (gap->size() < 3) continue;
    const double end = gap == &right ? length : 0.0;
    const ComplexVector parabola = gap->head(3);
    for (const Complex root : polynomial_roots(parabola)) {
      const Complex below = root.real();
      roots.push_back({root + end, parabola[0] + below * (parabola[1] + below * parabola[2])});
    }
  }
  return roots;
}

/// Gaps of the dense output at real places, against which hints are held.
class GapsOnStep {
 public:
  GapsOnStep(const PathNode& left, const PathNode& right, double length)
      : left_(left), right_(right), length_(length) {}

  /// Whether a parabola is about the gap below its root on the real axis. Most parabolas, and their roots,
  /// are not: the gap has changed otherwise on the way.
  bool agree(const EigenvalueBranch& a, const EigenvalueBranch& b, const RoughRoot& root) {
    constexpr double about = 0.15;  // a root at a wrong place costs time, a root that is left out an event
    const double t = root.position.real() / length_;
    if (!(t >= -behind_the_step(0.0) && t <= 1.0 + off_the_ends)) return false;
    const Complex distance = value(a, t) - value(b, t);
    const Complex gap = 0.25 * distance * distance;
    return std::abs(gap - root.gap_below) <= about * std::abs(gap);
  }

 private:
  Complex value(const EigenvalueBranch& branch, double t) {
    EigenvalueSampler& sampler =
        samplers_.try_emplace(branch.track, left_, right_, branch.track, length_).first->second;
    return sampler(std::clamp(t, 0.0, 1.0))[branch.members.front()];
  }

  const PathNode& left_;
  const PathNode& right_;
  double length_;
  std::map<std::size_t, EigenvalueSampler> samplers_;
};

}  // namespace

MeetingsOnStep expected_in_blocks(const PathNode& left, const PathNode& right, double length,
                                  const MeetingSearch& search) {
  // In steps: roots nearer to the left end are the known meeting there.
  constexpr double behind_a_meeting = 1e-4;
  std::vector<ExpectedMeeting> meetings;
  FirstRoots first_roots;
  for (std::size_t i = 0; i < left.tracks.size(); ++i) {
    const Track& track = left.tracks[i];
    if (track.size() < 2) continue;
    EigenvalueSampler sampler(left, right, i, length);
    double up_to = 1.0;
    if (const auto place = search.common ? common_place(track, sampler) : std::nullopt) {
      meetings.push_back(expected_of_all(track, i, place->t * length));
      first_roots.found(place->t);
      up_to = place->t - place->hidden_within;
    }
    const std::vector<EigenvalueBranch> branches = eigenvalue_branches_of(track, i, sampler);
    for (std::size_t a = 0; a < branches.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        Stretch stretch = where_told_apart(track, right.tracks[i], length, branches[a], branches[b]);
        stretch.to = std::min(stretch.to, up_to);
        if (stretch.from >= stretch.to) continue;
        const bool has_just_met = have_just_met(track, branches[a].members, branches[b].members);
        const double first = has_just_met ? behind_a_meeting : 0.0;
        RootsOnStep roots(sampler, branches[a].members.front(), branches[b].members.front(), looked_into,
                          stretch);
        std::vector<double> found;
        for (const Complex t : search.all ? roots.find() : roots.find_first(first, first_roots)) {
          if (t.real() > first) add_position(std::min(t.real(), 1.0) * length, found);
        }
        std::erase_if(found, [&](double position) {
          const double t = position / length;
          return t < stretch.from || t > stretch.to;
        });
        for (const double position : found) {
          meetings.push_back({branches[b], branches[a], position});
          meetings.back().has_just_met = has_just_met;
        }
      }
    }
  }
  std::stable_sort(meetings.begin(), meetings.end(), [](const ExpectedMeeting& x, const ExpectedMeeting& y) {
    return std::abs(x.position) < std::abs(y.position);
  });
  return {std::move(meetings), first_roots.up_to};
}

std::vector<ExpectedMeeting> expected_beside(const PathNode& left, const PathNode& right, double length,
                                             double width) {
  // In steps: meetings within a block that are closer to the real axis get a point of the trace
  // (landing.hpp).
  constexpr double on_axis = 1e-3;
  // Relative distance of a root from the conjugate of a known one, by rounding.
  constexpr double conjugate_rounding = 1e-6;
  // Predicted half-widths are inexact. A tenth more is accepted here; what is too wide once it is located is
  // left out then.
  constexpr double margin_of_width = 1.1;
  const double widest = margin_of_width * width;
  std::vector<ExpectedMeeting> meetings;
  const auto expect = [&](const EigenvalueBranch& a, const EigenvalueBranch& b, Complex position) {
    const double t = position.real() / length;
    const double off_axis = std::abs(position.imag());
    if (a.track == b.track && off_axis <= on_axis * std::abs(length)) return;
    const double behind = behind_the_step(off_axis / std::abs(length));
    const auto mirrors = [&](const ExpectedMeeting& other) {
      return other.a.track == a.track && other.b.track == b.track && other.a.members == a.members &&
             other.b.members == b.members &&
             std::abs(other.position - std::conj(position)) <= conjugate_rounding * off_axis;
    };
    if (std::any_of(meetings.begin(), meetings.end(), mirrors)) return;
    if (t > -behind && t < 1.0 + off_the_ends && off_axis <= widest) meetings.push_back({a, b, position});
  };
  std::vector<EigenvalueBranch> branches;
  for (std::size_t i = 0; i < left.tracks.size(); ++i) {
    const Track& track = left.tracks[i];
    if (track.size() == 1) {
      branches.push_back({i, {0}});
      continue;
    }
    EigenvalueSampler sampler(left, right, i, length);
    const std::size_t before = branches.size();
    for (EigenvalueBranch& branch : eigenvalue_branches_of(track, i, sampler)) {
      if (stands_for_a_mode(track, branch)) branches.push_back(std::move(branch));
    }
    if (track.size() == 2) continue;
    for (std::size_t a = before; a < branches.size(); ++a) {
      for (std::size_t b = before; b < a; ++b) {
        const Stretch stretch = where_told_apart(track, right.tracks[i], length, branches[a], branches[b]);
        if (stretch.from >= stretch.to) continue;
        RootsOnStep roots(sampler, branches[a].members.front(), branches[b].members.front(),
                          widest / std::abs(length), stretch);
        for (const Complex t : roots.find()) {
          if (roots.is_closest(t)) expect(branches[b], branches[a], t * length);
        }
      }
    }
  }
  std::vector<BranchSeries> seen;
  for (EigenvalueBranch& branch : branches) {
    ComplexVector at_left = series_of(left.tracks[branch.track], branch);
    ComplexVector at_right = series_of(right.tracks[branch.track], branch);
    seen.push_back({std::move(branch), std::move(at_left), std::move(at_right)});
  }
  GapsOnStep hints(left, right, length);
  for (const auto& [a, left_a, right_a] : seen) {
    for (const auto& [b, left_b, right_b] : seen) {
      if (&b == &a) break;
      if (left.tracks[a.track].pair.chart != left.tracks[b.track].pair.chart) continue;
      if (left.tracks[a.track].pair.part != left.tracks[b.track].pair.part) continue;
      const ComplexVector at_left = gap_at(left, b, left_b, a, left_a);
      const ComplexVector at_right = gap_at(right, b, right_b, a, right_a);
      if (stays_away(at_left, length, width) && stays_away(at_right, length, width)) continue;
      const std::size_t before = meetings.size();
      for (const Complex root : gap_roots(at_left, at_right, length, width)) expect(b, a, root);
      if (meetings.size() > before) continue;
      for (const RoughRoot& root : rough_roots(at_left, at_right, length)) {
        if (!hints.agree(a, b, root)) continue;
        expect(b, a, root.position);
        if (meetings.size() > before) meetings.back().is_rough = true;
      }
    }
  }
  return meetings;
}

}  // namespace eigentrail
