// Places near a step where two eigenvalues coincide, from the dense output. Those of a block are the roots of
// their gap ((s_a - s_b) / 2)^2, which is smooth where they meet. The error of an interpolant splits a double
// root into two close ones, also off the real axis. Therefore roots close to the axis and to the ends of an
// interval are accepted, too. Those of different blocks are the roots of their difference.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "continuation/tracks/eigenvalue_branches.hpp"
#include "eigentrail/core/chebyshev.hpp"

namespace eigentrail {

/// As a share of an interval: tests that there is no root cover a region larger by this on every side than
/// the one in which roots are accepted. Then rounding of roots at the border changes no result.
inline constexpr double margin_of_region = 0.02;

/// Up to where roots are wanted, in shares of a step. Shared by the searches for all pairs of a step.
struct FirstRoots {
  /// Also in shares of the step: roots so little behind the first one are still found.
  static constexpr double behind = 1e-2;

  double up_to = INFINITY;  ///< what lies beyond may be left out; lowered by what is found

  void found(double t) { up_to = std::min(up_to, t + behind); }
};

/// A part of a step, in shares of it.
struct Stretch {
  double from = 0.0, to = 1.0;
};

/// Chebyshev interpolants of the function on a step. Where it is not smooth, because one of the two
/// eigenvalues meets a third one, the step is halved repeatedly. On such a piece only roots up to half its
/// length off the real axis are found.
class RootsOnStep {
 public:
  using Distance = std::function<Complex(double)>;
  using Resolution = std::function<double(double)>;

  /// Of the gap of two eigenvalues of a block. `off_axis`: largest distance from the real axis of the roots
  /// that are wanted, in steps. `stretch`: what is looked at of the step.
  RootsOnStep(EigenvalueSampler& sampler, int a, int b, double off_axis, const Stretch& stretch);

  /// Of the difference of two eigenvalues of different blocks, both as functions of t. `resolution`: what
  /// counts as no difference.
  RootsOnStep(Distance distance, Resolution resolution, double off_axis)
      : distance_(std::move(distance)), resolution_(std::move(resolution)), off_axis_(off_axis) {}

  /// All roots, in shares of the step.
  std::vector<Complex> find();

  /// Of a gap that is not smooth only those up to `first`, which a root behind `from` lowers.
  std::vector<Complex> find_first(double from, FirstRoots& first);

  /// Whether the two eigenvalues are closer to each other at the real part of a root than on both sides of
  /// it. Roots for which this does not hold come from the interpolation of a function with kinks. At the
  /// distance of three half-widths from a true root a +- ib, the eigenvalues are sqrt(1 + 3^2) = 3.2 times as
  /// far apart.
  bool is_closest(Complex root);

 private:
  void search(double begin, double end);
  void add(Complex root);

  Distance distance_;
  Resolution resolution_;
  double off_axis_;
  Stretch stretch_ = {};
  bool of_gap_ = false;    ///< the roots of the gap are searched for, else those of the distance
  bool has_none_ = false;  ///< that is known without a search
  double from_ = 0.0;
  FirstRoots* first_ = nullptr;
  int pieces_ = 0;
  std::vector<Complex> roots_;
};

}  // namespace eigentrail
