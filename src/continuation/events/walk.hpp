// A safeguarded iteration (walk) to a special point.
//
// At each position a function, the look, estimates the distance to the special point; Newton's method on a
// power series is one such function. The walk converges when a move is no longer than the resolution, or when
// moves at the level of rounding no longer shrink. It fails when a position leaves the interval, when longer
// moves do not shrink, or after too many looks.
#pragma once

#include <cmath>

namespace eigentrail {

/// Largest number of looks at one special point. Newton's method squares the error each time, so about five
/// looks suffice near the solution; the others are for inaccurate guesses.
constexpr int most_looks = 8;

/// A move longer than this share of the move before does not count as shrinking: such an iteration would need
/// tens of looks.
constexpr double slowest_contraction = 0.5;

/// The result of one look.
struct Sight {
  enum class Kind {
    seen,     ///< `move` is an estimate of the distance to the special point
    settled,  ///< the same, and accurate enough to end the walk
    absent,   ///< the special point does not exist
    failed    ///< no estimate, for example because no point of the path was found
  } kind = Kind::failed;
  double move = 0.0;
};

/// How a walk ended. settled, absent, failed: as in Sight; outside: a position left the interval; wandering:
/// moves did not shrink; exhausted: too many looks.
enum class WalkEnd { settled, absent, failed, outside, wandering, exhausted };

struct WalkRules {
  double resolution = 0.0;                   ///< a move no longer than this settles the walk
  double rounding = 0.0;                     ///< so does one no longer than this that does not shrink
  double begin = -INFINITY, end = INFINITY;  ///< interval of the positions
  double slack = 0.0;                        ///< a position up to this far beyond `end` is replaced by `end`
  int free_moves = most_looks;  ///< after this many looks, a move that does not shrink ends the walk
  int looks = most_looks;       ///< largest number of looks
};

struct Walk {
  WalkEnd end = WalkEnd::exhausted;
  double position = 0.0;  ///< position of the last look, or the one outside the interval
  double move = 0.0;      ///< result of the last look
  int looks = 0;
};

/// Walks from `start`; look(position) returns a Sight.
template <class Look>
Walk walk(double start, const WalkRules& rules, Look&& look) {
  using Kind = Sight::Kind;
  Walk result;
  result.position = start;
  double last = INFINITY;
  while (result.looks < rules.looks) {
    ++result.looks;
    const Sight sight = look(result.position);
    result.move = sight.move;
    if (sight.kind == Kind::failed || sight.kind == Kind::absent) {
      result.end = sight.kind == Kind::failed ? WalkEnd::failed : WalkEnd::absent;
      return result;
    }
    const double length = std::abs(sight.move);
    const bool shrinks = length <= slowest_contraction * last;
    if (sight.kind == Kind::settled || length <= rules.resolution || (!shrinks && length <= rules.rounding)) {
      result.end = WalkEnd::settled;
      return result;
    }
    if (!shrinks && result.looks > rules.free_moves) {
      result.end = WalkEnd::wandering;
      return result;
    }
    last = length;
    result.position += sight.move;
    const double at = result.position;
    const double side = rules.end > rules.begin ? 1.0 : -1.0;
    if (!((at - rules.begin) * side > 0.0 && (at - rules.end) * side <= rules.slack)) {
      result.end = WalkEnd::outside;
      return result;
    }
    if ((at - rules.end) * side > 0.0) result.position = rules.end;
  }
  return result;
}

}  // namespace eigentrail
