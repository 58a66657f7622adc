#include "report/piecewise.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/piecewise_chebyshev.hpp"
#include "model/rational_interpolant.hpp"

namespace eigentrail {
namespace {

// Lengths are relative to that of the whole range.
constexpr double shortest_piece = 1e-13;  ///< shorter pieces are accepted without a test of the error
constexpr double shortest_at_gap = 1e-6;  ///< shorter pieces with values that are left out are not divided
/// The number of divisions is limited to pieces_besides + pieces_per_step * steps. Towards a place where
/// modes meet, about forty pieces of decreasing length are needed. If a function needs more pieces than the
/// limit, it is noise; its pieces are then accepted without a test of the error.
constexpr std::size_t pieces_per_step = 100;
constexpr std::size_t pieces_besides = 400;
/// Shorter pieces are not divided if all their values are left out.
constexpr double shortest_in_gap = 1e-3;

using PieceValues = std::vector<Complex>;

/// The Chebyshev-Lobatto points on [0, 1].
std::vector<double> places(int degree) {
  std::vector<double> u;
  for (int j = 0; j <= degree; ++j) u.push_back(0.5 * (1.0 - chebyshev_point(j, degree)));
  return u;
}

class Approximation {
 public:
  Approximation(const std::vector<double>& nodes, const std::function<Complex(std::size_t, double)>& value,
                const CurveOptions& options)
      : nodes_(nodes), value_(value), options_(options) {}

  std::vector<PiecewiseCurve> run() {
    halve({nodes_.front(), nodes_.back(), 0, nodes_.size() - 1});
    return std::move(curves_);
  }

 private:
  /// The interval [from, to], which lies between the nodes `first` and `last`.
  struct Range {
    double from, to;
    std::size_t first, last;
  };

  /// The function at a place of the range.
  Complex at(const Range& range, double place) const {
    const auto begin = nodes_.begin() + static_cast<std::ptrdiff_t>(range.first);
    const auto end = nodes_.begin() + static_cast<std::ptrdiff_t>(range.last);
    const auto behind = std::upper_bound(begin + 1, end, place);
    const auto i = static_cast<std::size_t>(behind - nodes_.begin()) - 1;
    const double width = nodes_[i + 1] - nodes_[i];  // zero if a step is below rounding of the path length
    return value_(i, width > 0.0 ? std::clamp((place - nodes_[i]) / width, 0.0, 1.0) : 1.0);
  }

  /// Whether a value is to be shown; false for NaN.
  bool fits(Complex value) const { return std::abs(value) <= options_.largest; }

  /// Whether the polynomial through `values` is accurate at a place of the range.
  bool meets(const Range& range, const PieceValues& values, double place) const {
    const Complex exact = at(range, place);
    const std::vector<double> basis = polynomial_.basis((place - range.from) / (range.to - range.from));
    const Complex error =
        exact - std::inner_product(values.begin(), values.end(), basis.begin(), Complex(0.0));
    return fits(exact) && std::abs(error.real()) <= options_.real_tolerance &&
           std::abs(error.imag()) <= options_.imag_tolerance;
  }

  /// Whether it is accurate between its points, and on every step if the range covers several.
  bool meets_everywhere(const Range& range, const PieceValues& values) const {
    for (std::size_t j = 0; j < options_.degree; ++j) {
      const double u = 0.5 * (places_[j] + places_[j + 1]);
      if (!meets(range, values, range.from + u * (range.to - range.from))) return false;
    }
    if (range.last - range.first < 2) return true;
    for (std::size_t i = range.first; i < range.last; ++i) {
      for (const double t : {0.0, 0.3, 0.7}) {
        const double here = nodes_[i] + t * (nodes_[i + 1] - nodes_[i]);
        if (here > range.from && here < range.to && !meets(range, values, here)) return false;
      }
    }
    return true;
  }

  /// Adds the range as one piece if it is accurate or may not be divided, otherwise its two parts.
  void halve(const Range& range) {
    const bool last = ++halved_ > pieces_besides + pieces_per_step * (nodes_.size() - 1);
    PieceValues values;
    for (const double u : places_) values.push_back(at(range, range.from + u * (range.to - range.from)));
    const auto fitting = std::count_if(values.begin(), values.end(), [this](Complex s) { return fits(s); });
    const bool finite = fitting == static_cast<std::ptrdiff_t>(values.size());
    const double shortest = (fitting == 0 ? shortest_in_gap : shortest_at_gap) * length_;
    if (finite &&
        (last || range.to - range.from <= shortest_piece * length_ || meets_everywhere(range, values))) {
      add(range, values);
    } else if (!last && (finite || range.to - range.from > shortest)) {
      const auto [left, right] = halves(range);
      if (left.to <= left.from || right.to <= right.from) return;
      halve(left);
      halve(right);
    }
  }

  /// The two parts of a range: divided at the middle one of the nodes inside, or in the middle if there is
  /// none.
  std::pair<Range, Range> halves(const Range& range) const {
    if (range.last - range.first > 1) {
      const std::size_t cut = (range.first + range.last) / 2;
      return {{range.from, nodes_[cut], range.first, cut}, {nodes_[cut], range.to, cut, range.last}};
    }
    const double middle = 0.5 * (range.from + range.to);
    return {{range.from, middle, range.first, range.last}, {middle, range.to, range.first, range.last}};
  }

  void add(const Range& range, const PieceValues& values) {
    if (curves_.empty() || curves_.back().knots.back() != range.from)
      curves_.push_back({{range.from}, {values[0]}});
    PiecewiseCurve& curve = curves_.back();
    curve.knots.push_back(range.to);
    curve.values.insert(curve.values.end(), values.begin() + 1, values.end());
  }

  const std::vector<double>& nodes_;
  const std::function<Complex(std::size_t, double)>& value_;
  const CurveOptions& options_;
  int degree_ = static_cast<int>(options_.degree);
  std::vector<double> places_ = places(degree_);
  RationalInterpolant polynomial_{places_, degree_};  ///< of the degree of all places
  double length_ = nodes_.back() - nodes_.front();
  std::size_t halved_ = 0;
  std::vector<PiecewiseCurve> curves_;
};

}  // namespace

std::vector<PiecewiseCurve> approximate(const std::vector<double>& nodes,
                                        const std::function<Complex(std::size_t, double)>& value,
                                        const CurveOptions& options) {
  return nodes.size() < 2 ? std::vector<PiecewiseCurve>{} : Approximation(nodes, value, options).run();
}

}  // namespace eigentrail
