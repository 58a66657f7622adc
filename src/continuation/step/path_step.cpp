#include "eigentrail/continuation/path_step.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// Roots are followed over a piece of a step if no difference of two of them changes by more than this share
/// of its smallest value there; else the piece is halved. Below one, a difference cannot turn round within a
/// piece. A larger value may exchange roots unnoticed, a smaller one needs more pieces.
constexpr double largest_change = 0.5;
/// Shortest piece, as a share of the step: rounding of t. Differences that still change by more at this
/// length count as indistinguishable.
constexpr double smallest_piece = 1e-14;
/// Roots that coincide everywhere cannot be distinguished by shorter pieces. After this many pieces the
/// shortest one is longer, so that following them ends. Narrow veerings need some fifty pieces.
constexpr int many_pieces = 300;
constexpr double smallest_of_many_pieces = 1e-2;  ///< shortest piece then, as a share of the step
/// Largest |Im t| of a root of dp/dt that counts as real. Two turning points that nearly coincide are
/// computed as a conjugate pair with imaginary parts up to the square root of rounding, 1e-8. A root too many
/// does no harm: p is monotonic on both sides of it.
constexpr double real_turning_point = 1e-7;
/// Positions with the same p on one step closer than this many square roots of epsilon are one: rounding
/// splits the single position at a fold into two.
constexpr double same_position = 4.0;
/// Distance relative to the largest root up to which two roots coincide: rounding with a margin. With a
/// larger value close roots count as one and are not certified apart, with a smaller one rounding separates
/// them.
constexpr double coincide_within = 1e-12;

/// The member of a conjugate pair with Im s >= 0.
Complex upper_member(Complex s) {
  return s.imag() < 0.0 ? std::conj(s) : s;
}

/// Roots of a block in the order of its modes, whose eigenvalues `at_end` are known at the same place.
ComplexVector ordered_by_modes(const ComplexVector& roots, const DenseBlock& block,
                               const ComplexVector& at_end) {
  const Eigen::Index k = roots.size();
  Matrix cost = Matrix::Zero(k, k);
  for (std::size_t i = 0; i < block.modes.size(); ++i) {
    const Complex known = chart_value(at_end[block.modes[i]], block.chart);
    for (Eigen::Index j = 0; j < k; ++j) {
      const double distance = std::abs(known - roots[j]);
      cost(static_cast<Eigen::Index>(i), j) = std::isfinite(distance) ? distance : 0.0;
    }
  }
  const std::vector<int> assignment = optimal_assignment(cost);
  ComplexVector ordered(k);
  for (Eigen::Index i = 0; i < k; ++i) ordered[i] = roots[assignment[static_cast<std::size_t>(i)]];
  return ordered;
}

/// Roots of `to` in the order of `from`, the roots a short piece before. A motion of the mean is subtracted
/// first. Then two roots are exchanged if their difference is small and has turned by more than 90 degrees.
ComplexVector continued(const ComplexVector& from, const ComplexVector& to) {
  const Complex drift = to.mean() - from.mean();
  ComplexVector roots = in_order_of(from.array() + drift, to);
  const double moved = (roots - from).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const Complex difference = roots[i] - roots[j];
      const bool turned = (std::conj(from[i] - from[j]) * difference).real() < 0.0;
      if (turned && std::abs(difference) < moved) std::swap(roots[i], roots[j]);
    }
  }
  return roots;
}

/// Checks whether roots can be distinguished on a piece of a step. `sets` are the roots at its begin, its
/// middle and its end.
class Differences {
 public:
  /// `roots` are those of the functions at `from`, the begin of the first piece. Roots that stay closer than
  /// the resolution there are one root. The functions must outlive the object.
  Differences(const HermiteInterpolant& functions, const ComplexVector& roots, double from)
      : functions_(functions),
        from_(from),
        scale_(coincide_within * roots.cwiseAbs().maxCoeff()),
        start_(roots),
        unclear_(static_cast<std::size_t>(roots.size() * roots.size()), false) {}

  /// Whether no difference of two roots changes by more than `largest_change`. Differences below the
  /// resolution at all three places are ignored.
  bool are_resolved(const std::array<const ComplexVector*, 3>& sets) {
    return all_pairs([&](Eigen::Index i, Eigen::Index j) {
      const auto vanishes = [&](const ComplexVector* roots) {
        return std::abs((*roots)[i] - (*roots)[j]) <= resolution_of(i, j);
      };
      return change(sets, i, j) <= 1.0 || std::all_of(sets.begin(), sets.end(), vanishes);
    });
  }

  /// Whether a shorter piece may distinguish what this one does not: not two roots that coincide within
  /// rounding at its middle or its end, where the roots are known to within `resolutions`.
  bool may_be_resolved(const std::array<const ComplexVector*, 3>& sets,
                       const std::array<Vector, 2>& resolutions) const {
    return !all_pairs([&](Eigen::Index i, Eigen::Index j) {
      const auto coincide = [&](std::size_t k) {
        const double known = std::min(resolutions[k][i], resolutions[k][j]);
        return known > 0.0 && std::abs((*sets[k + 1])[i] - (*sets[k + 1])[j]) <= 2.0 * known;
      };
      return change(sets, i, j) <= 1.0 || coincide(0) || coincide(1);
    });
  }

  /// Records the pairs of roots that could not be distinguished on a piece that is not halved further.
  void accept(const std::array<const ComplexVector*, 3>& sets) {
    all_pairs([&](Eigen::Index i, Eigen::Index j) {
      if (change(sets, i, j) > 1.0) unclear_[at(i, j)] = true;
      return true;
    });
  }

  /// Whether all pairs of roots that are distinct at the begin and at `end` could be distinguished between.
  bool were_told_apart(const ComplexVector& end) const {
    return all_pairs([&](Eigen::Index i, Eigen::Index j) {
      return !(unclear_[at(i, j)] && std::abs(start_[i] - start_[j]) > scale_ &&
               std::abs(end[i] - end[j]) > scale_);
    });
  }

 private:
  /// Computed when it is asked for: most pieces are resolved without it.
  double resolution_of(Eigen::Index i, Eigen::Index j) {
    if (resolutions_.size() == 0) resolutions_ = root_resolutions(functions_(from_), start_);
    return std::max(scale_, std::min(resolutions_[i], resolutions_[j]));
  }
  std::size_t at(Eigen::Index i, Eigen::Index j) const {
    return static_cast<std::size_t>(i * start_.size() + j);
  }
  template <class Condition>
  bool all_pairs(const Condition& holds) const {
    for (Eigen::Index i = 0; i < start_.size(); ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        if (!holds(i, j)) return false;
      }
    }
    return true;
  }
  /// Largest change of a difference from one place to the next, in units of the allowed change.
  static double change(const std::array<const ComplexVector*, 3>& sets, Eigen::Index i, Eigen::Index j) {
    const auto difference = [&](std::size_t k) { return (*sets[k])[i] - (*sets[k])[j]; };
    const Complex first = difference(0);
    const Complex second = difference(1);
    const Complex third = difference(2);
    const double least = std::min({std::abs(first), std::abs(second), std::abs(third)});
    const double change = std::max(std::abs(second - first), std::abs(third - second));
    return change > 0.0 ? change / std::max(largest_change * least, 1e-300) : 0.0;
  }

  const HermiteInterpolant& functions_;
  double from_;
  double scale_;
  Vector resolutions_;  ///< empty until they are asked for
  ComplexVector start_;
  std::vector<bool> unclear_;
};

/// How well the roots of a block can be distinguished, to compare both ends of a step: the logarithm of the
/// product of the distances of all pairs, for three and more relative to the condition numbers 1 / |y^H x| of
/// the two, with unit eigenvectors x and y. At an exceptional point rounding alone separates the roots, and
/// the condition numbers are large; roots that are as close to each other elsewhere are well conditioned.
/// Those that coincide on the whole step, as zeros of rigid-body motions, count alike at both ends.
double distinctness(const ComplexVector& functions, const ComplexVector& roots) {
  const Eigen::Index k = roots.size();
  if (k <= 2) return std::log(least_gap(roots));
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(ComplexMatrix(functions.reshaped(k, k)));
  const ComplexMatrix right = solver.eigenvectors();
  const ComplexMatrix left = right.inverse();
  const Vector condition = left.rowwise().norm().cwiseProduct(right.colwise().norm().transpose());
  const ComplexVector& s = solver.eigenvalues();
  const double hidden = coincide_within * s.cwiseAbs().maxCoeff();
  double sum = 0.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      sum += std::log(std::max(hidden, std::abs(s[i] - s[j]) / std::max(condition[i], condition[j])));
  }
  return std::isfinite(sum) ? sum : -INFINITY;
}

/// The function p(t) - p on a step for a given p. It is evaluated as the change of p from the nearer end, so
/// that it is accurate relative to that change. This matters beside a fold at the begin or end of a step.
class Miss {
 public:
  Miss(const PathStep& step, double p)
      : about_left_(shifted(step, step.parameter(0, 0))),
        about_right_(shifted(step, step.parameter(1, 0))),
        left_(p - step.parameter(0, 0)),
        right_(p - step.parameter(1, 0)),
        degree_(2 * static_cast<int>(step.parameter.cols()) - 1) {}

  double operator()(double t) const {
    return t <= 0.5 ? about_left_(t)[0].real() - left_ : about_right_(t)[0].real() - right_;
  }
  double slope(double t) const { return (t <= 0.5 ? about_left_ : about_right_).slope(t)[0].real(); }

  /// The places in (0, 1) with dp/dt = 0, ascending, followed by 1. p is monotonic between 0 and the first,
  /// and between neighbouring ones. Empty if the given p is farther from both ends than p moves on the step.
  std::vector<double> turning_points() const {
    std::vector<double> points;
    const auto slope_at = [this](double t) { return Complex(slope(t)); };
    const ComplexVector slopes = chebyshev_coefficients(slope_at, degree_ - 1);
    if (slopes.lpNorm<1>() < std::min(std::abs(left_), std::abs(right_))) return points;
    for (const Complex t : chebyshev_roots(slopes)) {
      if (std::abs(t.imag()) <= real_turning_point && t.real() > 0.0 && t.real() < 1.0)
        points.push_back(t.real());
    }
    points.push_back(1.0);
    std::sort(points.begin(), points.end());
    return points;
  }

 private:
  static HermiteInterpolant shifted(const PathStep& step, double p) {
    Matrix series = step.parameter;
    series.col(0).array() -= p;
    return {step.length, series.row(0).cast<Complex>(), series.row(1).cast<Complex>()};
  }

  HermiteInterpolant about_left_, about_right_;
  double left_, right_;
  int degree_;
};

/// The root of a monotonic function between `from` and `to`, if there is one: Newton's method, replaced by
/// bisection where it leaves the interval or its steps do not halve.
std::optional<double> root_between(const Miss& miss, double from, double to) {
  const double at_from = miss(from);
  if (at_from == 0.0) return from;
  if (miss(to) == 0.0) return to;
  if (at_from * miss(to) > 0.0) return std::nullopt;
  // Bisection alone reaches the resolution of a double within 60 steps or so; twice that is a safe limit.
  constexpr int most_steps = 120;
  double t = 0.5 * (from + to);
  double last_move = to - from;
  for (int i = 0; i < most_steps && from < to; ++i) {
    const double here = miss(t);
    if (here == 0.0) return t;
    (here * at_from > 0.0 ? from : to) = t;
    const double newton = t - here / miss.slope(t);
    const bool good = newton > from && newton < to && std::abs(newton - t) < 0.5 * last_move;
    const double next = good ? newton : 0.5 * (from + to);
    last_move = std::abs(next - t);
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace

ComplexVector follow_roots(const HermiteInterpolant& functions, const ComplexVector& roots, double from,
                           double to, bool* told_apart, std::size_t* work) {
  bool ignored = true;
  bool& are_told_apart = told_apart != nullptr ? *told_apart : ignored;
  are_told_apart = true;
  if (functions.size() == 1) return functions(to);
  if (!std::isfinite(to)) {
    are_told_apart = false;
    return ComplexVector::Constant(roots.size(), NAN);
  }
  Differences differences(functions, roots, from);
  ComplexVector current = roots;
  double t = from;
  double piece = to - from;
  for (int pieces = 0; t != to; ++pieces) {
    const double shortest = pieces < many_pieces ? smallest_piece : smallest_of_many_pieces;
    if (std::abs(piece) >= std::abs(to - t)) piece = to - t;
    // If two roots change places within a piece, its ends alone look as if nothing had happened. The middle
    // shows it.
    const ComplexVector middle = continued(current, block_roots(functions(t + 0.5 * piece)));
    const ComplexVector ahead = continued(middle, block_roots(functions(t + piece)));
    if (work != nullptr) *work += 2 * static_cast<std::size_t>(roots.size());
    const std::array<const ComplexVector*, 3> sets{&current, &middle, &ahead};
    const auto may_halve = [&] {
      return std::abs(piece) > shortest &&
             differences.may_be_resolved(sets, {root_resolutions(functions(t + 0.5 * piece), middle),
                                                root_resolutions(functions(t + piece), ahead)});
    };
    if (!differences.are_resolved(sets) && may_halve()) {
      piece *= 0.5;
      continue;
    }
    differences.accept(sets);
    t = piece == to - t ? to : t + piece;
    current = ahead;
    piece *= 2.0;
  }
  are_told_apart = differences.were_told_apart(current);
  return current;
}

Complex chart_value(Complex s, Chart chart) {
  if (chart == Chart::finite) return s;
  if (s == 0.0) return {INFINITY, 0.0};
  return std::isfinite(s.real()) && std::isfinite(s.imag()) ? 1.0 / s : Complex(0.0);
}

ComplexVector follow_roots(const DenseBlock& block, double length, const ComplexVector& roots, double from,
                           double to, bool* told_apart) {
  return follow_roots(HermiteInterpolant(length, block.left, block.right), roots, from, to, told_apart);
}

ComplexVector step_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                               const ComplexVector& at_right, double t, std::size_t* work) {
  ComplexVector s = ComplexVector::Constant(at_left.size(), Complex(NAN, NAN));
  for (const DenseBlock& block : step.blocks) {
    ComplexVector roots;
    if (block.size() == 1) {
      roots = HermiteInterpolant(step.length, block.left, block.right)(t);
    } else {
      // Followed from the end where the eigenvalues are better distinguished: where they coincide, they do
      // not determine the order.
      const ComplexVector left = block_roots(block.left.col(0));
      const ComplexVector right = block_roots(block.right.col(0));
      if (work != nullptr) *work += 2 * static_cast<std::size_t>(block.size());
      const bool from_left = distinctness(block.left.col(0), left) >= distinctness(block.right.col(0), right);
      const ComplexVector start =
          ordered_by_modes(from_left ? left : right, block, from_left ? at_left : at_right);
      roots = follow_roots(HermiteInterpolant(step.length, block.left, block.right), start,
                           from_left ? 0.0 : 1.0, t, nullptr, work);
    }
    for (std::size_t i = 0; i < block.modes.size(); ++i) {
      s[block.modes[i]] = upper_member(chart_value(roots[static_cast<Eigen::Index>(i)], block.chart));
    }
  }
  return s;
}

bool follows_parameter(const PathStep& step) {
  return step.parameter.rightCols(step.parameter.cols() - 1).leftCols(1).isOnes(0.0) &&
         step.parameter.rightCols(step.parameter.cols() - 2).isZero(0.0);
}

std::vector<double> step_positions(const PathStep& step, double p) {
  const double a = step.parameter(0, 0);
  const double b = step.parameter(1, 0);
  if (follows_parameter(step)) {
    const double t = (p - a) / (b - a);
    return t >= 0.0 && t <= 1.0 ? std::vector<double>{t} : std::vector<double>{};
  }
  const Miss miss(step, p);
  // Of positions that are one, the end t = 1 is kept exactly.
  const double apart = same_position * std::sqrt(std::numeric_limits<double>::epsilon());
  std::vector<double> positions;
  const auto add = [&](double t) {
    if (positions.empty() || t > positions.back() + apart) {
      positions.push_back(t);
    } else if (t == 1.0) {
      positions.back() = t;
    }
  };
  double from = 0.0;
  for (const double to : miss.turning_points()) {
    if (const std::optional<double> t = root_between(miss, from, to)) add(*t);
    from = to;
  }
  return positions;
}

}  // namespace eigentrail
