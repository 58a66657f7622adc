#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "continuation/step/path_step.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "report/file_data.hpp"
#include "report/piecewise.hpp"

namespace eigentrail {
namespace {

/// An eigenvalue is not shown if it exceeds this multiple of the median, over all points, of the largest
/// eigenvalue: it goes to infinity.
constexpr double beyond = 100.0;
/// Least tolerance of the curves, relative to the largest eigenvalue of a mode: they are not more accurate.
constexpr double known_share = 1e-12;

/// Accuracy of the curves in the page: `share` is the tolerance relative to the range of the real and
/// imaginary parts, `degree` that of the polynomials. The first entry whose curves fit the budget is used,
/// otherwise the last one, which is still accurate enough to read numbers from the page.
struct Closeness {
  double share;
  std::size_t degree;
};
constexpr std::array<Closeness, 3> closeness{{{1e-8, 6}, {1e-7, 6}, {2.5e-7, 3}}};

/// For each step and each mode in a block of several, the number of eigenvalues that may be computed grows by
/// ReportBudget::roots divided by this: by 10,000 with the usual budget. Where modes are close, some hundred
/// are computed on a step, where modes meet, a quarter of a million. In a damaged file, where modes change
/// places all the time, no number would be enough.
constexpr std::size_t share_of_step = 1000;

/// Counts the eigenvalues that are computed from the functions of blocks, and limits their number.
class RootBudget {
 public:
  RootBudget(const LociFile& loci, std::size_t besides) : path_(loci.path), most_(besides) {
    for (const PathStep& step : loci.steps) {
      for (const DenseBlock& block : step.blocks)
        most_ += block.size() > 1 ? besides / share_of_step * block.modes.size() : 0;
    }
  }
  std::size_t& used() { return used_; }
  void check() const {
    if (used_ > most_) {
      throw InputError(path_ +
                       ": the eigenvalues of a block change places too often to be drawn; is the file "
                       "damaged? Trace the scene again");
    }
  }

 private:
  std::string path_;
  std::size_t most_;
  std::size_t used_ = 0;
};

/// The distance along the path from its beginning, at every point of the trace.
std::vector<double> distances(const LociFile& loci) {
  std::vector<double> list{0.0};
  for (const PathStep& step : loci.steps) list.push_back(list.back() + std::abs(step.length));
  return list;
}

/// Whether rounding leaves the eigenvalues of a block distinct, or lets all of them be one.
enum class Seen { apart, doubtful, as_one };
Seen how_seen(const ComplexVector& functions) {
  constexpr double margin = 10.0;  // on rounding
  const Eigen::Index k = block_size(functions.size());
  const Vector errors = margin * function_rounding(ComplexMatrix(functions.reshaped(k, k)));
  const ComplexVector s = block_roots(functions);
  if (are_told_apart(functions, s, errors)) return Seen::apart;
  const double radius = (s.array() - s.mean()).abs().maxCoeff();
  return radius <= root_errors(functions, s, errors).maxCoeff() ? Seen::as_one : Seen::doubtful;
}

/// Distance from an end of a step, in shares of it, within which rounding hides the eigenvalues of a block of
/// three or more that are one there. What the functions give for each of them is noise up to there.
double hidden_beside(const HermiteInterpolant& functions, double end) {
  constexpr double nearest = 1e-6;
  if (functions.size() <= 4 || how_seen(functions(end)) != Seen::as_one) return 0.0;
  double distance = nearest;
  while (distance < 1.0 && how_seen(functions(std::abs(end - distance))) != Seen::apart) distance *= 2.0;
  return std::min(distance, 1.0);
}

/// The dense output of one mode on the steps from `first` to the last one before the mode ceases to exist.
class ModeStretch {
 public:
  ModeStretch(const LociFile& loci, int mode, std::size_t first, RootBudget& budget)
      : loci_(loci), mode_(mode), first_(first), budget_(budget) {
    for (std::size_t i = first; i < loci.steps.size(); ++i) {
      const PathStep& step = loci.steps[i];
      const DenseBlock* block = loci.block_of(i, mode);
      if (block == nullptr) break;
      alone_.emplace_back();
      hidden_.emplace_back();
      const HermiteInterpolant functions(step.length, block->left, block->right);
      if (block->size() == 1) {
        alone_.back() = functions;
      } else {
        hidden_.back() = {hidden_beside(functions, 0.0), hidden_beside(functions, 1.0)};
      }
      blocks_.push_back(block);
    }
    for (std::size_t i = 0; i < hidden_.size(); ++i) {
      if (hidden_[i].left > 0.0) hidden_[i].at_left = value(i, hidden_[i].left);
      if (hidden_[i].right > 0.0) hidden_[i].at_right = value(i, 1.0 - hidden_[i].right);
    }
  }

  std::size_t first() const { return first_; }
  std::size_t n_steps() const { return blocks_.size(); }

  /// The eigenvalue at t in [0, 1] on step i of the stretch, equal to the output of `eigentrail eval`. Beside
  /// a point where many are one, as far as rounding hides them, a chord.
  Complex operator()(std::size_t i, double t) const {
    const Hidden& hidden = hidden_[i];
    const auto chord = [&](double end, double share, Complex to) {
      return value(i, end) + share * (to - value(i, end));
    };
    if (t < hidden.left) return chord(0.0, t / hidden.left, hidden.at_left);
    if (1.0 - t < hidden.right) return chord(1.0, (1.0 - t) / hidden.right, hidden.at_right);
    return value(i, t);
  }

 private:
  Complex value(std::size_t i, double t) const {
    const auto node = static_cast<Eigen::Index>(first_ + i);
    if (t == 0.0) return loci_.eigenvalues(node, mode_);
    if (t == 1.0) return loci_.eigenvalues(node + 1, mode_);
    if (alone_[i]) {
      const Complex s = chart_value((*alone_[i])(t)[0], blocks_[i]->chart);
      return s.imag() < 0.0 ? std::conj(s) : s;
    }
    const PathStep step{loci_.steps[first_ + i].length, loci_.steps[first_ + i].parameter, {*blocks_[i]}};
    budget_.check();
    return counted_eigenvalues(step, loci_.eigenvalues.row(node).transpose(),
                               loci_.eigenvalues.row(node + 1).transpose(), t, budget_.used())[mode_];
  }

  /// Parts of a step, from its left and to its right end, and the eigenvalue at their borders.
  struct Hidden {
    double left = 0.0, right = 0.0;
    Complex at_left = {}, at_right = {};
  };

  const LociFile& loci_;
  int mode_;
  std::size_t first_;
  RootBudget& budget_;
  std::vector<const DenseBlock*> blocks_;
  std::vector<std::optional<HermiteInterpolant>> alone_;
  std::vector<Hidden> hidden_;
};

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double range() const { return high > low ? high - low : 0.0; }
};

/// The largest magnitude of an eigenvalue that is shown: see `beyond`.
double largest_shown(const LociFile& loci) {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < loci.eigenvalues.rows(); ++i) {
    double size = 0.0;
    for (const Complex s : loci.eigenvalues.row(i)) {
      if (std::isfinite(std::abs(s))) size = std::max(size, std::abs(s));
    }
    sizes.push_back(size);
  }
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  return std::max(beyond * sizes[sizes.size() / 2], std::numeric_limits<double>::min());
}

PiecewiseOptions options_for(const ModeStretch& mode, const Closeness& close, double largest) {
  Extent real, imag, size;
  for (std::size_t i = 0; i < mode.n_steps(); ++i) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Complex s = mode(i, t);
      if (!(std::abs(s) <= largest)) continue;
      real.add(s.real());
      imag.add(s.imag());
      size.add(std::abs(s));
    }
  }
  const double least = std::max(known_share * size.high, std::numeric_limits<double>::min());
  return {close.degree, std::max(close.share * real.range(), least),
          std::max(close.share * imag.range(), least), largest};
}

/// The values as integers of 32 bits: value = middle + unit * integer, for real and imaginary parts
/// separately. The middle is a multiple of the unit, so zero is represented exactly.
Json fixed_point(const std::vector<Complex>& values) {
  Extent real, imag;
  for (const Complex s : values) {
    real.add(s.real());
    imag.add(s.imag());
  }
  constexpr double numbers_in_range = 4294967290.0;  // a little less than 2^32, for rounding at the ends
  const auto unit = [](const Extent& extent) { return extent.range() / numbers_in_range; };
  const auto middle = [&](const Extent& extent) {
    const double plain = 0.5 * (extent.low + extent.high);
    const double step = unit(extent);
    const double whole = step > 0.0 ? std::round(plain / step) * step : plain;
    return std::isfinite(whole) ? whole : plain;
  };
  const auto number = [&](double value, const Extent& extent) {
    if (unit(extent) == 0.0) return std::int32_t{0};
    return static_cast<std::int32_t>(
        std::clamp(std::round((value - middle(extent)) / unit(extent)), -2147483647.0, 2147483647.0));
  };
  std::vector<std::int32_t> numbers;
  numbers.reserve(2 * values.size());
  for (const Complex s : values) {
    numbers.push_back(number(s.real(), real));
    numbers.push_back(number(s.imag(), imag));
  }
  return {{"scale", {middle(real), unit(real), middle(imag), unit(imag)}}, {"values", base64(numbers)}};
}

struct ModeCurves {
  std::vector<std::vector<PiecewiseCurve>> modes;
  std::size_t bytes = 0;
};

ModeCurves approximate_modes(const LociFile& loci, const std::vector<double>& places, const Closeness& close,
                             std::size_t budget, RootBudget& roots) {
  const double largest = largest_shown(loci);
  ModeCurves result;
  for (std::size_t mode = 0; mode < loci.modes.size() && result.bytes <= budget; ++mode) {
    std::vector<PiecewiseCurve>& curves = result.modes.emplace_back();
    for (std::size_t step = 0; step < loci.steps.size(); ++step) {
      const ModeStretch stretch(loci, static_cast<int>(mode), step, roots);
      if (stretch.n_steps() == 0) continue;
      const auto begin = places.begin() + static_cast<std::ptrdiff_t>(step);
      const std::vector<double> nodes(begin, begin + static_cast<std::ptrdiff_t>(stretch.n_steps()) + 1);
      const auto value = [&stretch](std::size_t i, double t) { return stretch(i, t); };
      for (PiecewiseCurve& curve : approximate(nodes, value, options_for(stretch, close, largest))) {
        result.bytes += curve.knots.size() * sizeof(double) + 2 * curve.values.size() * sizeof(std::int32_t);
        curves.push_back(std::move(curve));
      }
      step += stretch.n_steps() - 1;
    }
  }
  return result;
}

Json parameter_data(const LociFile& loci, const std::vector<double>& places) {
  PiecewiseOptions options;
  options.real_tolerance = options.imag_tolerance =
      std::max(1e-11 * (loci.highest() - loci.lowest()), std::numeric_limits<double>::min());
  options.largest = std::numeric_limits<double>::max();
  const auto value = [&loci](std::size_t i, double t) { return Complex(loci.parameter_at({i, t})); };
  const std::vector<PiecewiseCurve> curves = approximate(places, value, options);
  if (curves.size() != 1) throw InputError(loci.path + ": the parameter is not continuous along the path");
  std::vector<double> values;
  for (const Complex p : curves[0].values) values.push_back(p.real());
  return {{"degree", options.degree}, {"knots", base64(curves[0].knots)}, {"values", base64(values)}};
}

}  // namespace

Json curves_data(const LociFile& loci, const ReportBudget& budget) {
  const std::vector<double> places = distances(loci);
  ModeCurves curves;
  Closeness used = closeness.back();
  RootBudget roots(loci, budget.roots);
  for (const Closeness& close : closeness) {
    const bool last = close.degree == closeness.back().degree && close.share == closeness.back().share;
    curves = approximate_modes(loci, places, close, last ? SIZE_MAX : budget.curves, roots);
    used = close;
    if (curves.bytes <= budget.curves) break;
  }
  Json data{{"closeness", used.share}, {"degree", used.degree}};
  data["nodes"] = {{"place", base64(places)}, {"parameter", base64(loci.p)}};
  data["parameter"] = parameter_data(loci, places);
  for (const std::vector<PiecewiseCurve>& mode : curves.modes) {
    Json stretches = Json::array();
    for (const PiecewiseCurve& curve : mode) {
      Json stretch = fixed_point(curve.values);
      stretch["knots"] = base64(curve.knots);
      stretches.push_back(std::move(stretch));
    }
    data["modes"].push_back(std::move(stretches));
  }
  return data;
}

}  // namespace eigentrail
