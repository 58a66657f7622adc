// Bisection.
#pragma once

namespace eigentrail {

/// Two places next to each other, between which a condition ceases to hold.
struct Bisected {
  double last, first_without;  ///< the last place at which it holds, the first one at which it does not

  double middle() const { return 0.5 * (last + first_without); }
};

/// The places, after so many bisections, of a condition that holds at `from` and not at `to`.
template <class Condition>
Bisected bisected(double from, double to, int halvings, const Condition& holds) {
  for (int i = 0; i < halvings && from != to; ++i) {
    const double middle = 0.5 * (from + to);
    (holds(middle) ? from : to) = middle;
  }
  return {from, to};
}

}  // namespace eigentrail
