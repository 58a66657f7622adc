#include "continuation/events/expected_meetings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "continuation/step/shared_basis.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Double roots of an interpolant may lie this share of an interval off the axis, or off its ends.
constexpr double looked_into = 0.1;
constexpr double beside = 0.05;
constexpr double smallest_piece = 1e-8;  ///< of a step
/// Of an interval: roots that are not computed, because there are none, lie farther outside by this.
constexpr double margin = 0.02;

bool stands_for_a_mode(const Track& track, const Strand& strand) {
  return std::any_of(strand.members.begin(), strand.members.end(),
                     [&](int i) { return track.modes[static_cast<std::size_t>(i)] >= 0; });
}

/// Roots of a gap near a step, in shares of it. A gap that is not smooth there, because one of the two meets
/// a third on the way, is looked at piece by piece; roots farther off the axis than a piece is long are not
/// seen.
class RootsOnStep {
 public:
  /// Roots farther off the axis than `off_axis` are not asked for.
  RootsOnStep(StrandSampler& sampler, int a, int b, double off_axis)
      : sampler_(sampler), a_(a), b_(b), off_axis_(off_axis) {}

  std::vector<Complex> find() {
    if (!of_two_has_none()) search(0.0, 1.0);
    return roots_;
  }

  /// Whether the two come closest where a root is said to lie: interpolants of kinks have others.
  bool is_closest(Complex root) {
    constexpr double farther = 1.3;
    const double reach = 3.0 * std::abs(root.imag());
    const double at = std::clamp(root.real(), 0.0, 1.0);
    const double here = std::abs(distance(at));
    const auto parts = [&](double t) {
      return t < 0.0 || t > 1.0 || std::abs(distance(t)) >= farther * here;
    };
    return parts(at - reach) && parts(at + reach);
  }

 private:
  static constexpr int degree = 12;
  static constexpr double resolved = 1e-4;
  /// A kink takes some thirty pieces. A gap of many more is rounding: the two are one, as at s = 0 where no
  /// force acts.
  static constexpr int most_pieces = 300;

  Complex distance(double t) {
    const ComplexVector& roots = sampler_(t);
    return roots[a_] - roots[b_];
  }
  bool given_up() const { return pieces_ > most_pieces; }

  /// Where a piece of that length is looked at for roots.
  Rectangle looked_at(double length) const {
    return {0.5, 0.5 + beside + margin, farthest_off_axis(length) + margin};
  }
  double farthest_off_axis(double length) const { return std::min(0.5, off_axis_ / length); }

  /// The gap of a block of two is one of its functions, which need not be sampled to tell that it has no
  /// root.
  bool of_two_has_none() const {
    const HermiteInterpolant& functions = sampler_.functions();
    if (functions.size() != 2) return false;
    Rectangle step = looked_at(1.0);
    const double middle = std::exchange(step.center, 0.0).real();
    return has_no_root_in(functions.series(middle, functions.degree()).row(1).transpose(), step);
  }

  /// Far apart for what they move on the piece.
  bool stay_apart(double begin, double end) {
    constexpr double share = 3.0;
    double least = INFINITY;
    double moved = 0.0;
    const Complex start = distance(begin);
    for (int i = 0; i <= 4; ++i) {
      const Complex d = distance(begin + (end - begin) * 0.25 * i);
      least = std::min(least, std::abs(d));
      moved = std::max(moved, std::abs(d - start));
    }
    return least > share * moved;
  }

  void search(double begin, double end) {
    if (given_up() || stay_apart(begin, end)) return;
    ++pieces_;
    if (given_up()) roots_.clear();
    const double length = end - begin;
    if (length < smallest_piece) {
      if (roots_.empty() || std::abs(begin - roots_.back()) > 10.0 * smallest_piece) roots_.push_back(begin);
      return;
    }
    const auto gap = [&](double u) {
      const Complex d = distance(begin + u * length);
      return 0.25 * d * d;
    };
    const ComplexVector coefficients = chebyshev_coefficients(gap, degree);
    if (std::sqrt(coefficients.cwiseAbs().maxCoeff()) <= sampler_.resolution()) return;
    if (coefficients.tail(2).cwiseAbs().maxCoeff() > resolved * coefficients.cwiseAbs().maxCoeff()) {
      const double middle = begin + 0.5 * length;
      search(begin, middle);
      search(middle, end);
      return;
    }
    if (chebyshev_has_no_root_in(coefficients, looked_at(length))) return;
    for (const Complex root : chebyshev_roots(coefficients)) {
      const bool on_piece = root.real() > -beside && root.real() < 1.0 + beside;
      if (on_piece && std::abs(root.imag()) <= farthest_off_axis(length))
        roots_.push_back(begin + root * length);
    }
  }

  StrandSampler& sampler_;
  int a_, b_;
  double off_axis_;
  int pieces_ = 0;
  std::vector<Complex> roots_;
};

/// Whether both have just met at the left end: their gap's root there is known.
bool have_just_met(const Track& track, const std::vector<int>& a, const std::vector<int>& b) {
  const auto met = [&](int i) { return std::find(track.met.begin(), track.met.end(), i) != track.met.end(); };
  return met(a.front()) && met(b.front());
}

/// Adds a position unless one is there already, up to a share of it: two roots beside the axis are one place.
void add_position(double position, std::vector<double>& found, double share = 1e-3) {
  const auto is_there = [&](double other) {
    return std::abs(other - position) <= share * std::abs(position);
  };
  if (std::none_of(found.begin(), found.end(), is_there)) found.push_back(position);
}

/// The series at the left end tells roots close to it that an interpolant over the whole step blurs.
void add_near_left_end(const Track& track, const std::vector<int>& a, const std::vector<int>& b,
                       double length, std::vector<double>& found) {
  constexpr double close = 0.2;    // of the step: as far as the series tells
  constexpr double apart = 1e-6;   // of the step: nearer ones are at the end itself
  constexpr double on_axis = 0.1;  // double roots split
  constexpr double known = 0.1;
  const ComplexVector gap = discriminant_of(track, a, b);
  if (gap.size() == 0 || has_no_root_within(gap, close * std::abs(length))) return;
  for (const Complex root : polynomial_roots(gap)) {
    const Complex t = root / length;
    if (t.real() < apart || t.real() > close || std::abs(t.imag()) > on_axis * t.real()) continue;
    add_position(root.real(), found, known);
  }
}

/// How far the dense output of a block of two may misplace a root of its gap on the real axis.
double doubt_of_root(const PathNode& left, const PathNode& right, std::size_t track, double length,
                     double position) {
  if (left.tracks[track].size() != 2) return INFINITY;
  constexpr Eigen::Index gap = 1;  // of the functions
  const HermiteInterpolant functions = functions_on_step(left, right, track, length);
  const double slope = std::abs(functions.slope(position / length)[gap] / length);
  // Where it does not vanish the root lies beside the axis.
  return (functions.error_without_last()[gap] + std::abs(functions(position / length)[gap])) / slope;
}

}  // namespace

std::vector<ExpectedMeeting> expected_in_blocks(const PathNode& left, const PathNode& right, double length) {
  constexpr double behind_a_meeting = 1e-4;
  std::vector<ExpectedMeeting> meetings;
  for (std::size_t i = 0; i < left.tracks.size(); ++i) {
    const Track& track = left.tracks[i];
    if (track.size() < 2) continue;
    StrandSampler sampler(left, right, i, length);
    const std::vector<Strand> strands = strands_of(track, i, sampler);
    for (std::size_t a = 0; a < strands.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (!stands_for_a_mode(track, strands[a]) && !stands_for_a_mode(track, strands[b])) continue;
        const double first =
            have_just_met(track, strands[a].members, strands[b].members) ? behind_a_meeting : 0.0;
        RootsOnStep roots(sampler, strands[a].members.front(), strands[b].members.front(), looked_into);
        std::vector<double> found;
        for (const Complex t : roots.find()) {
          if (t.real() > first) add_position(std::min(t.real(), 1.0) * length, found);
        }
        add_near_left_end(track, strands[a].members, strands[b].members, length, found);
        for (const double position : found) {
          meetings.push_back({strands[b], strands[a], position});
          meetings.back().doubt = doubt_of_root(left, right, i, length, position);
        }
      }
    }
  }
  std::stable_sort(meetings.begin(), meetings.end(), [](const ExpectedMeeting& x, const ExpectedMeeting& y) {
    return std::abs(x.position) < std::abs(y.position);
  });
  return meetings;
}

namespace {

/// Mean of a strand at one end; empty when it cannot be told.
ComplexVector strand_series(const Track& track, const Strand& strand) {
  if (track.size() == 1) return track.functions.row(0).transpose();
  std::vector<Complex> roots;
  for (const int i : strand.members) roots.push_back(track.roots[i]);
  const std::vector<ComplexMatrix> part = part_series(track.series.Lambda, roots);
  return part.empty() ? ComplexVector() : mean_series(part);
}

/// A strand's mean at one end, and a bound of how far it moves within some reach of it.
struct MovingMean {
  MovingMean(const Track& track, const Strand& strand, double reach) : series(strand_series(track, strand)) {
    double power = 1.0;
    for (Eigen::Index k = 1; k < series.size(); ++k) moves += std::abs(series[k]) * (power *= reach);
  }

  ComplexVector series;  ///< empty when it cannot be told
  double moves = 0.0;
};

/// Whether the square of their distance certainly has no root within reach, all its coefficients bounded by
/// those of the factors: (|d| + m)^2 - |d|^2 < |d|^2 where m < (sqrt 2 - 1) |d|.
bool stay_apart(const MovingMean& a, const MovingMean& b) {
  constexpr double share = 0.41;
  if (a.series.size() == 0 || b.series.size() == 0) return false;
  return a.moves + b.moves < share * std::abs(a.series[0] - b.series[0]);
}

/// A strand as seen from both ends of the step.
struct SeenStrand {
  Strand strand;
  MovingMean left, right;
};

std::vector<SeenStrand> seen_from_both_ends(std::vector<Strand> strands, const PathNode& left,
                                            const PathNode& right, double reach) {
  std::vector<SeenStrand> seen;
  for (Strand& strand : strands) {
    MovingMean from(left.tracks[strand.track], strand, reach);
    MovingMean to(right.tracks[strand.track], strand, reach);
    seen.push_back({std::move(strand), std::move(from), std::move(to)});
  }
  return seen;
}

ComplexVector gap_at(const PathNode& node, const Strand& a, const MovingMean& mean_a, const Strand& b,
                     const MovingMean& mean_b) {
  if (a.track == b.track) return discriminant_of(node.tracks[a.track], a.members, b.members);
  if (mean_a.series.size() == 0 || mean_b.series.size() == 0) return {};
  return discriminant_series(mean_a.series, mean_b.series);
}

/// Roots of an interpolant where its last term is a larger share than this are its own, not the function's.
constexpr double told_by_series = 0.05;

/// How far from the ends of a step of that length roots of gaps are looked for.
double reach_of(double length, double width) {
  return std::abs(length) + 2.0 * width;
}

/// What lies outside these shares of the step is left out when it is located; beside a short step far ones
/// are told poorly, and the next, longer steps look back.
constexpr double off_the_ends = 0.1;
double behind_the_step(double off_axis) {
  return std::max(off_the_ends, 0.2 * off_axis);
}

/// Where roots off the axis by up to `off_axis` (in steps) are of interest, in shares of the step; a little
/// larger, for the rounding of roots.
Rectangle surroundings(double off_axis) {
  const double from = -behind_the_step(off_axis) - margin;
  const double to = 1.0 + off_the_ends + margin;
  return {0.5 * (from + to), 0.5 * (to - from), off_axis + margin};
}

/// Roots of the gap as seen from both ends, or from the one where the two can be told from all others.
std::vector<Complex> gap_roots(const ComplexVector& left, const ComplexVector& right, double length,
                               double width) {
  const double reach = reach_of(length, width);
  if (left.size() == 0 && right.size() == 0) return {};
  if (left.size() == 0 || right.size() == 0) {
    const ComplexVector& gap = left.size() == 0 ? right : left;
    if (has_no_root_within(gap, reach)) return {};
    std::vector<Complex> roots = polynomial_roots(gap);
    for (Complex& root : roots) root += left.size() == 0 ? length : 0.0;
    return roots;
  }
  if (has_no_root_within(left, reach) && has_no_root_within(right, reach)) return {};
  const HermiteInterpolant gap(length, left.transpose(), right.transpose());
  const double widest = (1.0 + told_by_series) * width / std::abs(length);
  Rectangle step = surroundings(widest);
  const double middle = std::exchange(step.center, 0.0).real();
  if (has_no_root_in(gap.series(middle, gap.degree()).row(0).transpose(), step)) return {};
  std::vector<Complex> roots =
      chebyshev_roots(chebyshev_coefficients([&](double t) { return gap(t)[0]; }, gap.degree()));
  std::erase_if(roots, [&](Complex t) {
    const double share = gap.last_share(0, t);
    return share > told_by_series || std::abs(t.imag() * length) > (1.0 + share) * width;
  });
  for (Complex& root : roots) root *= length;
  return roots;
}

}  // namespace

std::vector<ExpectedMeeting> expected_beside(const PathNode& left, const PathNode& right, double length,
                                             double width) {
  constexpr double on_axis = 1e-3;
  const double widest = 1.1 * width;  // what is wider is left out when it is located
  std::vector<ExpectedMeeting> meetings;
  const auto expect = [&](const Strand& a, const Strand& b, Complex position,
                          const ComplexVector& at_left = {}, const ComplexVector& at_right = {}) {
    const double t = position.real() / length;
    const double off_axis = std::abs(position.imag());
    // Nearer ones within a block have a point of their own.
    if (a.track == b.track && off_axis <= on_axis * std::abs(length)) return;
    const double behind = behind_the_step(off_axis / std::abs(length));
    const auto mirrors = [&](const ExpectedMeeting& other) {
      return other.a.track == a.track && other.b.track == b.track && other.a.members == a.members &&
             other.b.members == b.members &&
             std::abs(other.position - std::conj(position)) <= 1e-6 * off_axis;
    };
    if (std::any_of(meetings.begin(), meetings.end(), mirrors)) return;
    if (t > -behind && t < 1.0 + off_the_ends && off_axis <= widest)
      meetings.push_back({a, b, position, at_left, at_right});
  };
  std::vector<Strand> strands;
  for (std::size_t i = 0; i < left.tracks.size(); ++i) {
    const Track& track = left.tracks[i];
    if (track.size() == 1) {
      strands.push_back({i, {0}});
      continue;
    }
    StrandSampler sampler(left, right, i, length);
    const std::size_t before = strands.size();
    for (Strand& strand : strands_of(track, i, sampler)) {
      if (stands_for_a_mode(track, strand)) strands.push_back(std::move(strand));
    }
    if (track.size() == 2) continue;
    for (std::size_t a = before; a < strands.size(); ++a) {
      for (std::size_t b = before; b < a; ++b) {
        RootsOnStep roots(sampler, strands[a].members.front(), strands[b].members.front(),
                          widest / std::abs(length));
        for (const Complex t : roots.find()) {
          if (roots.is_closest(t)) expect(strands[b], strands[a], t * length);
        }
      }
    }
  }
  const std::vector<SeenStrand> seen =
      seen_from_both_ends(std::move(strands), left, right, reach_of(length, width));
  for (const auto& [a, left_a, right_a] : seen) {
    for (const auto& [b, left_b, right_b] : seen) {
      if (&b == &a) break;
      if (left.tracks[a.track].pair.chart != left.tracks[b.track].pair.chart) continue;
      if (a.track != b.track && stay_apart(left_a, left_b) && stay_apart(right_a, right_b)) continue;
      const ComplexVector at_left = gap_at(left, b, left_b, a, left_a);
      const ComplexVector at_right = gap_at(right, b, right_b, a, right_a);
      for (const Complex root : gap_roots(at_left, at_right, length, width))
        expect(b, a, root, at_left, at_right);
    }
  }
  return meetings;
}

}  // namespace eigentrail
