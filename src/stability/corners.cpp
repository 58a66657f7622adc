#include "stability/corners.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

// Lengths are in the scaled window.
constexpr int pieces = 8;  ///< straight pieces that a step is divided into to find intersections
constexpr int most_corner_corrections = 10;
constexpr double corner_settled = 1e-14;    ///< smaller Newton corrections are rounding
constexpr double corner_stagnated = 1e-10;  ///< corrections below this that no longer halve are rounding
constexpr double same_corner = 1e-7;        ///< corners of the same curves closer than this are one
/// Largest relative difference of the predicted coordinates of one equilibrium: the error of predictions.
constexpr double same_coordinates = 1e-4;
/// Least sine of the angle between the two curves: below it they touch and do not intersect.
constexpr double least_sine = 1e-3;

/// A step as a polygon with its bounding box.
struct Chain {
  std::array<Place, pieces + 1> places;
  Place low, high;
};

Chain chain_of(const ChordStep& step) {
  Chain chain;
  chain.low = chain.high = step.place(0.0);
  for (int i = 0; i <= pieces; ++i) {
    Place& place = chain.places[static_cast<std::size_t>(i)];
    place = step.place(static_cast<double>(i) / pieces);
    chain.low = chain.low.cwiseMin(place);
    chain.high = chain.high.cwiseMax(place);
  }
  return chain;
}

bool apart(const Place& low_a, const Place& high_a, const Place& low_b, const Place& high_b) {
  return (low_a.array() > high_b.array()).any() || (low_b.array() > high_a.array()).any();
}

/// The intersection of two straight pieces, as fractions of the length of each; empty if there is none.
std::optional<Place> intersection(const Place& a0, const Place& a1, const Place& b0, const Place& b1) {
  if (apart(a0.cwiseMin(a1), a0.cwiseMax(a1), b0.cwiseMin(b1), b0.cwiseMax(b1))) return std::nullopt;
  Eigen::Matrix2d sides;
  sides << a1 - a0, b0 - b1;
  if (std::abs(sides.determinant()) <= 1e-12 * (a1 - a0).norm() * (b1 - b0).norm()) return std::nullopt;
  const Place shares = sides.inverse() * (b0 - a0);
  constexpr double slack = 1e-3;  // the curves deviate from the straight pieces
  const bool inside = shares.minCoeff() >= -slack && shares.maxCoeff() <= 1.0 + slack;
  return inside ? std::optional(shares) : std::nullopt;
}

/// Whether two predicted equilibria are the same: their coordinates differ by no more than the error of the
/// predictions.
bool same_equilibrium(const PlaceGuess& a, const PlaceGuess& b) {
  constexpr double rounding = 1e-12;
  const Vector& x = a.equilibrium.x;
  const Vector& y = b.equilibrium.x;
  return (x - y).norm() <= std::max(same_coordinates * std::max(x.norm(), y.norm()), rounding);
}

class CornerFinder {
 public:
  CornerFinder(const Window& window, const std::vector<FollowedCurve>& curves, RunCounts& counts)
      : window_(window), curves_(curves), counts_(counts) {
    for (const FollowedCurve& curve : curves) {
      std::vector<Chain>& chains = chains_.emplace_back();
      std::transform(curve.steps.begin(), curve.steps.end(), std::back_inserter(chains), chain_of);
    }
  }

  /// Takens-Bogdanov points: ends of curves of complex pairs that lie on a curve of divergence.
  void add_ends(double tolerance) {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      for (const CurvePoint& point : curves_[i].points) {
        if ((point.flags & takens_bogdanov_flag) == 0) continue;
        for (std::size_t j = 0; j < curves_.size(); ++j) {
          if (curves_[j].function.kind == BoundaryKind::divergence &&
              curves_[j].passes(point.place(), 0.0, tolerance, window_.reference()))
            add(CornerKind::takens_bogdanov, point.place(), {0.0, 0.0}, i, j);
        }
      }
    }
  }

  void add_intersections() {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      for (std::size_t j = i; j < curves_.size(); ++j) {
        for (std::size_t a = 0; a < chains_[i].size(); ++a) {
          for (std::size_t b = 0; b < chains_[j].size(); ++b) {
            if (!are_neighbours({i, a}, {j, b})) look_at({i, a}, {j, b});
          }
        }
      }
    }
  }

  FoundCorners found() && {
    // At a Takens-Bogdanov point the curve of pairs touches the curve of divergence. An intersection of these
    // two curves close to it is the same point.
    FoundCorners result{{}, std::move(findings_)};
    for (const Corner& corner : corners_) {
      const bool touches =
          corner.kind == CornerKind::intersection &&
          std::any_of(corners_.begin(), corners_.end(), [&](const Corner& other) {
            constexpr double near = 1e-4;  // of the window
            return other.kind == CornerKind::takens_bogdanov && (other.place - corner.place).norm() < near &&
                   std::is_permutation(other.curves.begin(), other.curves.end(), corner.curves.begin());
          });
      if (!touches) result.corners.push_back(corner);
    }
    for (Corner& corner : result.corners) corner.place = window_.declared(corner.place);
    return result;
  }

 private:
  /// A step of a curve, both numbered from 0.
  struct At {
    std::size_t curve, step;
  };

  bool are_neighbours(At a, At b) const {
    if (a.curve != b.curve) return false;
    const std::size_t count = curves_[a.curve].steps.size();
    const bool closed = curves_[a.curve].end.how == CurveEnd::closed;
    return b.step <= a.step + 1 || (closed && a.step == 0 && b.step + 1 == count);
  }

  void look_at(At a, At b) {
    const Chain& first = chains_[a.curve][a.step];
    const Chain& second = chains_[b.curve][b.step];
    if (apart(first.low, first.high, second.low, second.high)) return;
    for (std::size_t k = 0; k < pieces; ++k) {
      for (std::size_t l = 0; l < pieces; ++l) {
        const auto shares =
            intersection(first.places[k], first.places[k + 1], second.places[l], second.places[l + 1]);
        if (!shares) continue;
        const Place t = (Place(static_cast<double>(k), static_cast<double>(l)) + *shares) / pieces;
        const PlaceGuess first_guess = guess_at(a, t[0]);
        if (!same_equilibrium(first_guess, guess_at(b, t[1]))) {
          findings_.push_back(
              {"intersections of curves that belong to different equilibria, which are no corners",
               window_.text(first_guess.place)});
        } else if (!locate(a, b, t)) {
          locate_on_dense(a, b, t);
        }
      }
    }
  }

  /// Newton's method for g = 0 of both modes from t on the two steps; false if it finds no solution nearby.
  /// Equilibrium and both modes are computed again at every iterate.
  bool locate(At a, At b, const Place& t) {
    const std::array<At, 2> at{a, b};
    std::array<PlaceGuess, 2> guess{guess_at(a, t[0]), guess_at(b, t[1])};
    const Place start = guess[0].place;
    const double reach = curves_[a.curve].steps[a.step].length + curves_[b.curve].steps[b.step].length;
    guess[1].place = start;
    double last = INFINITY;
    for (int i = 0; i < most_corner_corrections; ++i) {
      Eigen::Matrix2d slopes;
      Place values;
      std::array<Situation, 2> there;
      for (std::size_t k = 0; k < 2; ++k) {
        const BoundaryFunction& function = curves_[at[k].curve].function;
        there[k] = compute_situation(window_, function, guess[k], counts_);
        if (!there[k].computed()) return false;
        const auto gradients = function_gradients(window_, there[k], function, counts_);
        if (!gradients) return false;
        const auto row = static_cast<Eigen::Index>(k);
        slopes.row(row) = gradient(function, there[k].functions, *gradients).transpose();
        const double scale = slopes.row(row).norm();
        slopes.row(row) /= scale;
        values[row] = function.series(there[k].functions)[0] / scale;
      }
      const Place move = -slopes.inverse() * values;
      const double size = move.norm();
      if (!((there[0].place + move - start).norm() <= reach)) return false;
      if (size <= corner_settled || (size > 0.5 * last && last <= corner_stagnated)) {
        if (Window::contains(there[0].place))
          add(CornerKind::intersection, there[0].place, {eigenvalue(a, there[0]), eigenvalue(b, there[1])},
              a.curve, b.curve);
        return true;
      }
      last = size;
      for (std::size_t k = 0; k < 2; ++k) guess[k] = as_guess(there[k], there[k].place + move);
    }
    return false;
  }

  /// The intersection of the dense output of the two steps. Needed where a zero set of one function g
  /// intersects itself: grad g vanishes there and Newton's method for g fails.
  void locate_on_dense(At a, At b, Place t) {
    const ChordStep& first = curves_[a.curve].steps[a.step];
    const ChordStep& second = curves_[b.curve].steps[b.step];
    for (int i = 0; i < most_corner_corrections; ++i) {
      Eigen::Matrix2d slopes;
      slopes << first.slope(t[0]), -second.slope(t[1]);
      if (!(std::abs(slopes.determinant()) > least_sine * slopes.col(0).norm() * slopes.col(1).norm()))
        return;
      const Place move = slopes.inverse() * (second.place(t[1]) - first.place(t[0]));
      t = (t + move).cwiseMax(0.0).cwiseMin(1.0);
      if (move.norm() > corner_stagnated) continue;
      if ((second.place(t[1]) - first.place(t[0])).norm() > same_corner) return;
      const auto root = [](const Eigen::Vector4d& at) { return at[2] + std::sqrt(Complex(at[3])); };
      add(CornerKind::intersection, first.place(t[0]), {root(first(t[0])), root(second(t[1]))}, a.curve,
          b.curve);
      return;
    }
  }

  PlaceGuess guess_at(At at, double t) const {
    const FollowedCurve& curve = curves_[at.curve];
    const Place place = curve.steps[at.step].place(t);
    const CurvePoint& base = curve.points[at.step + (t > 0.5 ? 1 : 0)];
    return predict(base, base.tangent().dot(place - base.place()));
  }

  /// The eigenvalue of the block with Im s >= 0; 0 for divergence.
  Complex eigenvalue(At at, const Situation& situation) const {
    if (curves_[at.curve].function.kind == BoundaryKind::divergence) return 0.0;
    const ComplexVector roots = block_roots(situation.functions.col(0).head(2));
    return roots[0].imag() >= 0.0 ? roots[0] : roots[1];
  }

  void add(CornerKind kind, const Place& place, std::array<Complex, 2> s, std::size_t a, std::size_t b) {
    const std::array<int, 2> curves{static_cast<int>(a), static_cast<int>(b)};
    const bool known = std::any_of(corners_.begin(), corners_.end(), [&](const Corner& corner) {
      return corner.curves == curves && (corner.place - place).norm() < same_corner;
    });
    if (!known) corners_.push_back({kind, place, s, curves});
  }

  const Window& window_;
  const std::vector<FollowedCurve>& curves_;
  RunCounts& counts_;
  std::vector<std::vector<Chain>> chains_;
  std::vector<Corner> corners_;  ///< with scaled places; found() converts them
  std::vector<Finding> findings_;
};

}  // namespace

FoundCorners find_corners(const Window& window, const std::vector<FollowedCurve>& curves, double tolerance,
                          RunCounts& counts) {
  CornerFinder finder(window, curves, counts);
  finder.add_ends(tolerance);
  finder.add_intersections();
  return std::move(finder).found();
}

}  // namespace eigentrail
