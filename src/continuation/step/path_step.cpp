#include "eigentrail/continuation/path_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "continuation/step/path_step.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// The difference of two roots may change by this share of itself, or it is looked at more closely.
constexpr double largest_change = 0.5;
constexpr double smallest_piece = 1e-14;  ///< of a step
/// Eigenvalues that coincide throughout cannot be told apart; after this many pieces nobody tries any longer.
constexpr int patience = 300;
constexpr double piece_without_patience = 1e-2;

Complex upper_member(Complex s) {
  return s.imag() < 0.0 ? std::conj(s) : s;
}

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

/// Roots of `to` in the order of `from`, a short piece before: their differences keep their directions,
/// however far all of them move together.
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

/// Differences of roots on their way from one end of a piece over its middle to the other.
class Differences {
 public:
  /// Roots closer than `resolution` all along are one.
  Differences(const ComplexVector& roots, double resolution)
      : scale_(coinciding * roots.cwiseAbs().maxCoeff()),
        resolution_(std::max(scale_, resolution)),
        start_(roots),
        unclear_(static_cast<std::size_t>(roots.size() * roots.size()), false) {}

  /// Whether none changes by more than a part of itself. Those that vanish all along do not count.
  bool are_resolved(const std::array<const ComplexVector*, 3>& sets) const {
    return all_pairs([&](Eigen::Index i, Eigen::Index j) {
      const auto vanishes = [&](const ComplexVector* roots) {
        return std::abs((*roots)[i] - (*roots)[j]) <= resolution_;
      };
      return change(sets, i, j) <= 1.0 || std::all_of(sets.begin(), sets.end(), vanishes);
    });
  }

  /// The piece is taken as it is.
  void accept(const std::array<const ComplexVector*, 3>& sets) {
    all_pairs([&](Eigen::Index i, Eigen::Index j) {
      if (change(sets, i, j) > 1.0) unclear_[at(i, j)] = true;
      return true;
    });
  }

  /// Whether no two that are distinct at both ends were unclear on the way.
  bool were_told_apart(const ComplexVector& end) const {
    return all_pairs([&](Eigen::Index i, Eigen::Index j) {
      return !(unclear_[at(i, j)] && std::abs(start_[i] - start_[j]) > scale_ &&
               std::abs(end[i] - end[j]) > scale_);
    });
  }

 private:
  static constexpr double coinciding = 1e-12;

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
  /// Largest change of a difference in units of what is allowed.
  static double change(const std::array<const ComplexVector*, 3>& sets, Eigen::Index i, Eigen::Index j) {
    const auto difference = [&](std::size_t k) { return (*sets[k])[i] - (*sets[k])[j]; };
    const Complex first = difference(0);
    const Complex second = difference(1);
    const Complex third = difference(2);
    const double least = std::min({std::abs(first), std::abs(second), std::abs(third)});
    const double change = std::max(std::abs(second - first), std::abs(third - second));
    return change > 0.0 ? change / std::max(largest_change * least, 1e-300) : 0.0;
  }

  double scale_;
  double resolution_;
  ComplexVector start_;
  std::vector<bool> unclear_;
};

/// p(t) - p on a step, as seen from the nearer end: accurate relatively to the distance from the value there,
/// so that positions beside a fold that a step begins or ends with are as accurate as that allows.
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

  /// Ascending, between 0 and 1, and 1 itself: p is monotonic from 0 to the first, and from one to the next.
  std::vector<double> turning_points() const {
    std::vector<double> points;
    const auto slope_at = [this](double t) { return Complex(slope(t)); };
    for (const Complex t : chebyshev_roots(chebyshev_coefficients(slope_at, degree_ - 1))) {
      if (std::abs(t.imag()) <= 1e-7 && t.real() > 0.0 && t.real() < 1.0) points.push_back(t.real());
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

/// The root of a monotonic function: Newton's method, kept between the ends by halving.
std::optional<double> root_between(const Miss& miss, double from, double to) {
  const double at_from = miss(from);
  if (at_from == 0.0) return from;
  if (miss(to) == 0.0) return to;
  if (at_from * miss(to) > 0.0) return std::nullopt;
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

/// follow_roots; `work` counts roots.
ComplexVector followed(const HermiteInterpolant& functions, const ComplexVector& roots, double from,
                       double to, bool& told_apart, std::size_t& work) {
  told_apart = true;
  if (functions.size() == 1) return functions(to);
  if (!std::isfinite(to)) {
    told_apart = false;
    return ComplexVector::Constant(roots.size(), std::numeric_limits<double>::quiet_NaN());
  }
  // Blocks of two have none, and are looked at most often.
  Differences differences(roots, functions.size() > 2 ? root_resolution(functions(from), roots) : 0.0);
  ComplexVector current = roots;
  double t = from;
  double piece = to - from;
  for (int pieces = 0; t != to; ++pieces) {
    const double shortest = pieces < patience ? smallest_piece : piece_without_patience;
    if (std::abs(piece) >= std::abs(to - t)) piece = to - t;
    // Seen from its two ends alone a piece in which roots change places looks like one in which nothing
    // happens; its middle tells.
    const ComplexVector middle = continued(current, block_roots(functions(t + 0.5 * piece)));
    const ComplexVector ahead = continued(middle, block_roots(functions(t + piece)));
    work += 2 * static_cast<std::size_t>(roots.size());
    const std::array<const ComplexVector*, 3> sets{&current, &middle, &ahead};
    if (!differences.are_resolved(sets) && std::abs(piece) > shortest) {
      piece *= 0.5;
      continue;
    }
    differences.accept(sets);
    t = piece == to - t ? to : t + piece;
    current = ahead;
    piece *= 2.0;
  }
  told_apart = differences.were_told_apart(current);
  return current;
}

}  // namespace

Complex chart_value(Complex s, Chart chart) {
  if (chart == Chart::finite) return s;
  if (s == 0.0) return {std::numeric_limits<double>::infinity(), 0.0};
  return std::isfinite(s.real()) && std::isfinite(s.imag()) ? 1.0 / s : Complex(0.0);
}

ComplexVector follow_roots(const DenseBlock& block, double length, const ComplexVector& roots, double from,
                           double to, bool* told_apart) {
  return follow_roots(HermiteInterpolant(length, block.left, block.right), roots, from, to, told_apart);
}

ComplexVector follow_roots(const HermiteInterpolant& functions, const ComplexVector& roots, double from,
                           double to, bool* told_apart) {
  bool told = true;
  std::size_t work = 0;
  ComplexVector result = followed(functions, roots, from, to, told, work);
  if (told_apart != nullptr) *told_apart = told;
  return result;
}

ComplexVector step_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                               const ComplexVector& at_right, double t) {
  std::size_t work = 0;
  return counted_eigenvalues(step, at_left, at_right, t, work);
}

ComplexVector counted_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                                  const ComplexVector& at_right, double t, std::size_t& work) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ComplexVector s = ComplexVector::Constant(at_left.size(), Complex(nan, nan));
  for (const DenseBlock& block : step.blocks) {
    ComplexVector roots;
    if (block.size() == 1) {
      roots = HermiteInterpolant(step.length, block.left, block.right)(t);
    } else {
      // Followed from the end where the eigenvalues lie further apart: at a special point they do not tell.
      const ComplexVector left = block_roots(block.left.col(0));
      const ComplexVector right = block_roots(block.right.col(0));
      work += 2 * static_cast<std::size_t>(block.size());
      const bool from_left = least_gap(left) >= least_gap(right);
      const ComplexVector start =
          ordered_by_modes(from_left ? left : right, block, from_left ? at_left : at_right);
      bool told_apart = true;
      roots =
          followed({step.length, block.left, block.right}, start, from_left ? 0.0 : 1.0, t, told_apart, work);
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
  // Rounding splits the one point at the parameter of a fold into two, sqrt(epsilon) apart; ends stay exact.
  const double apart = 4.0 * std::sqrt(std::numeric_limits<double>::epsilon());
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
