// A safeguarded walk to a special point.
//
// From a guess, each look at a position tells how far away the place lies as seen from there; Newton's method
// on a series is one such look. The walk ends where the move is at the level of what is asked for, or where
// moves no longer become smaller at the level of rounding. It ends without a place where positions leave
// the interval, moves do not shrink, or looks run out.
#pragma once

#include <algorithm>
#include <cmath>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Points computed for one special point, at most: Newton's method squares the error, so eight take any guess
/// within reach to rounding, with some to spare for the first, coarse ones.
constexpr int most_looks = 8;

/// What is seen from a position. Position: double, or Complex beside the real axis.
template <class Position>
struct Sight {
  enum class Kind {
    seen,     ///< the place lies `move` away, about
    settled,  ///< the place lies `move` away, as accurately as it is wanted
    absent,   ///< there is no such place
    failed    ///< nothing can be told from here: no point was found
  } kind = Kind::failed;
  Position move = {};
};

enum class WalkEnd { settled, absent, failed, outside, wandering, exhausted };

struct WalkRules {
  double resolution = 0.0;  ///< a move no longer than this settles the walk
  double rounding = 0.0;    ///< so does one no longer than this that is not half as long as the last one
  double begin = -INFINITY, end = INFINITY;  ///< positions (real parts) lie between these
  double slack = 0.0;           ///< beyond `end`, up to this distance, a position counts as `end`
  int free_moves = most_looks;  ///< after this many a move that is not half as long as the last ends the walk
  int looks = most_looks;
};

template <class Position>
struct Walk {
  WalkEnd end = WalkEnd::exhausted;
  Position position = {};  ///< the last one looked from, or the one outside
  Position move = {};      ///< from there to the place, as far as seen
  int looks = 0;
};

/// Walks from `start`; look(position) returns a Sight<Position>.
template <class Position, class Look>
Walk<Position> walk(Position start, const WalkRules& rules, Look&& look) {
  using Kind = typename Sight<Position>::Kind;
  Walk<Position> result;
  result.position = start;
  double last = INFINITY;
  while (result.looks < rules.looks) {
    ++result.looks;
    const Sight<Position> sight = look(result.position);
    result.move = sight.move;
    if (sight.kind == Kind::failed || sight.kind == Kind::absent) {
      result.end = sight.kind == Kind::failed ? WalkEnd::failed : WalkEnd::absent;
      return result;
    }
    const double length = std::abs(sight.move);
    const bool shrinks = length <= 0.5 * last;
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
    const double at = std::real(result.position);
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
