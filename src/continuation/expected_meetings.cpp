#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/meetings.hpp"
#include "continuation/shared_basis.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Double roots of an interpolant may lie this share of an interval off the axis, or off its ends.
constexpr double looked_into = 0.1;
constexpr double beside = 0.05;
constexpr double smallest_piece = 1e-8;     ///< of a step
constexpr double coinciding_share = 1e-12;  ///< of the size of a block: closer eigenvalues are one

bool stands_for_a_mode(const Track& track, const Strand& strand) {
  return std::any_of(strand.members.begin(), strand.members.end(),
                     [&](int i) { return track.modes[static_cast<std::size_t>(i)] >= 0; });
}

/// Roots of a gap near a step, in shares of it. A gap that is not smooth there, because one of the two meets
/// a third on the way, is looked at piece by piece; roots farther off the axis than a piece is long are not
/// seen.
class RootsOnStep {
 public:
  /// Closer than `coinciding` throughout, the two are one.
  RootsOnStep(StrandSampler& sampler, int a, int b, double coinciding)
      : sampler_(sampler), a_(a), b_(b), coinciding_(coinciding) {}

  std::vector<Complex> find() {
    search(0.0, 1.0);
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

  Complex distance(double t) {
    const ComplexVector& roots = sampler_(t);
    return roots[a_] - roots[b_];
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
    if (stay_apart(begin, end)) return;
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
    if (std::sqrt(coefficients.cwiseAbs().maxCoeff()) <= coinciding_) return;
    if (coefficients.tail(2).cwiseAbs().maxCoeff() > resolved * coefficients.cwiseAbs().maxCoeff()) {
      const double middle = begin + 0.5 * length;
      search(begin, middle);
      search(middle, end);
      return;
    }
    for (const Complex root : chebyshev_roots(coefficients)) {
      const bool on_piece = root.real() > -beside && root.real() < 1.0 + beside;
      if (on_piece && std::abs(root.imag()) <= 0.5) roots_.push_back(begin + root * length);
    }
  }

  StrandSampler& sampler_;
  int a_, b_;
  double coinciding_;
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
  const ComplexVector gap = gap_of(track, a, b);
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
  const DenseBlock block = block_on_step(left, right, track);
  const HermiteInterpolant gap(length, block.left.row(1), block.right.row(1));
  const double slope = std::abs(gap.slope(position / length)[0] / length);
  // Where it does not vanish the root lies beside the axis.
  return (gap.error_without_last()[0] + std::abs(gap(position / length)[0])) / slope;
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
        RootsOnStep roots(sampler, strands[a].members.front(), strands[b].members.front(),
                          coinciding_share * track.pair.Lambda.norm());
        std::vector<double> found;
        for (const Complex t : roots.find()) {
          if (t.real() > first && std::abs(t.imag()) <= looked_into)
            add_position(std::min(t.real(), 1.0) * length, found);
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

ComplexVector gap_at(const PathNode& node, const Strand& a, const Strand& b) {
  if (a.track == b.track) return gap_of(node.tracks[a.track], a.members, b.members);
  const ComplexVector first = strand_series(node.tracks[a.track], a);
  const ComplexVector second = strand_series(node.tracks[b.track], b);
  return first.size() == 0 || second.size() == 0 ? ComplexVector() : gap_series(first, second);
}

/// Roots of an interpolant where its last term is a larger share than this are its own, not the function's.
constexpr double told_by_series = 0.05;

/// Roots of the gap as seen from both ends, or from the one where the two can be told from all others.
std::vector<Complex> gap_roots(const ComplexVector& left, const ComplexVector& right, double length,
                               double width) {
  const double reach = std::abs(length) + 2.0 * width;
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
  const int degree = 2 * static_cast<int>(left.size()) - 1;
  std::vector<Complex> roots =
      chebyshev_roots(chebyshev_coefficients([&](double t) { return gap(t)[0]; }, degree));
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
  constexpr double off_the_ends = 0.1;  // estimates: what lies outside is left out when it is located
  constexpr double on_axis = 1e-3;
  std::vector<ExpectedMeeting> meetings;
  const auto expect = [&](const Strand& a, const Strand& b, Complex position,
                          const ComplexVector& at_left = {}, const ComplexVector& at_right = {}) {
    const double t = position.real() / length;
    const double off_axis = std::abs(position.imag());
    // Nearer ones within a block have a point of their own.
    if (a.track == b.track && off_axis <= on_axis * std::abs(length)) return;
    // Beside a short step far ones are told poorly: the next, longer steps look back.
    const double behind = std::max(off_the_ends, 0.2 * off_axis / std::abs(length));
    const auto mirrors = [&](const ExpectedMeeting& other) {
      return other.a.track == a.track && other.b.track == b.track && other.a.members == a.members &&
             other.b.members == b.members &&
             std::abs(other.position - std::conj(position)) <= 1e-6 * off_axis;
    };
    if (std::any_of(meetings.begin(), meetings.end(), mirrors)) return;
    if (t > -behind && t < 1.0 + off_the_ends && off_axis <= 1.1 * width)
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
                          coinciding_share * track.pair.Lambda.norm());
        for (const Complex t : roots.find()) {
          if (roots.is_closest(t)) expect(strands[b], strands[a], t * length);
        }
      }
    }
  }
  for (std::size_t a = 0; a < strands.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (left.tracks[strands[a].track].pair.chart != left.tracks[strands[b].track].pair.chart) continue;
      const ComplexVector at_left = gap_at(left, strands[b], strands[a]);
      const ComplexVector at_right = gap_at(right, strands[b], strands[a]);
      for (const Complex root : gap_roots(at_left, at_right, length, width))
        expect(strands[b], strands[a], root, at_left, at_right);
    }
  }
  return meetings;
}

}  // namespace eigentrail
