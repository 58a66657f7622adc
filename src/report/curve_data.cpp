#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

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

/// Counts the eigenvalues that are computed from the functions of blocks.
struct RootCount {
  std::size_t most = 0;
  std::size_t used = 0;
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
  ModeStretch(const LociFile& loci, int mode, std::size_t first, RootCount& roots)
      : loci_(loci), mode_(mode), first_(first), roots_(roots) {
    for (std::size_t i = first; i < loci.steps.size(); ++i) {
      const PathStep& step = loci.steps[i];
      const DenseBlock* block = loci.block_of(i, mode);
      if (block == nullptr) break;
      const HermiteInterpolant functions(step.length, block->left, block->right);
      steps_.push_back({block, functions, hidden_beside(functions, 0.0), hidden_beside(functions, 1.0)});
    }
  }

  std::size_t n_steps() const { return steps_.size(); }

  /// The eigenvalue at t in [0, 1] on step i of the stretch, equal to the output of `eigentrail eval`. Beside
  /// a point where many are one, as far as rounding hides them, a chord.
  Complex operator()(std::size_t i, double t) const {
    const auto chord = [&](double end, double border) {
      return value(i, end) + (t - end) / (border - end) * (value(i, border) - value(i, end));
    };
    if (t < steps_[i].left) return chord(0.0, steps_[i].left);
    if (1.0 - t < steps_[i].right) return chord(1.0, 1.0 - steps_[i].right);
    return value(i, t);
  }

 private:
  Complex value(std::size_t i, double t) const {
    const auto node = static_cast<Eigen::Index>(first_ + i);
    if (t == 0.0) return loci_.eigenvalues(node, mode_);
    if (t == 1.0) return loci_.eigenvalues(node + 1, mode_);
    if (steps_[i].block->size() == 1) {
      const Complex s = chart_value(steps_[i].functions(t)[0], steps_[i].block->chart);
      return s.imag() < 0.0 ? std::conj(s) : s;
    }
    const PathStep step{
        loci_.steps[first_ + i].length, loci_.steps[first_ + i].parameter, {*steps_[i].block}};
    if (roots_.used > roots_.most) {
      throw InputError(loci_.path +
                       ": the eigenvalues of a block change places too often to be drawn; is the file "
                       "damaged? Trace the scene again");
    }
    return step_eigenvalues(step, loci_.eigenvalues.row(node).transpose(),
                            loci_.eigenvalues.row(node + 1).transpose(), t, &roots_.used)[mode_];
  }

  /// `left`, `right`: shares of the step at its ends in which rounding hides the eigenvalues.
  struct Step {
    const DenseBlock* block;
    HermiteInterpolant functions;
    double left, right;
  };

  const LociFile& loci_;
  int mode_;
  std::size_t first_;
  RootCount& roots_;
  std::vector<Step> steps_;
};

/// The largest magnitude of an eigenvalue that is shown: see `beyond`.
double largest_shown(const LociFile& loci) {
  const auto finite = [](double size) { return std::isfinite(size) ? size : 0.0; };
  Vector sizes = loci.eigenvalues.cwiseAbs().unaryExpr(finite).rowwise().maxCoeff();
  std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
  return std::max(beyond * sizes[sizes.size() / 2], std::numeric_limits<double>::min());
}

CurveOptions options_for(const ModeStretch& mode, const Closeness& close, double largest) {
  Eigen::AlignedBox3d seen;  // of the real part, the imaginary part and the magnitude
  for (std::size_t i = 0; i < mode.n_steps(); ++i) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Complex s = mode(i, t);
      if (std::abs(s) <= largest) seen.extend(Eigen::Vector3d(s.real(), s.imag(), std::abs(s)));
    }
  }
  const double least = std::max(known_share * seen.max()[2], std::numeric_limits<double>::min());
  const Eigen::Vector3d range = close.share * seen.sizes();
  return {close.degree, std::max(range[0], least), std::max(range[1], least), largest};
}

/// The values as integers of 32 bits: value = middle + unit * integer, for real and imaginary parts
/// separately. The middle is a multiple of the unit, so zero is represented exactly.
Json fixed_point(const std::vector<Complex>& values) {
  constexpr double numbers_in_range = 4294967290.0;  // a little less than 2^32, for rounding at the ends
  std::vector<double> scale;
  std::vector<std::int32_t> numbers(2 * values.size());
  const Eigen::Map<const Eigen::Matrix2Xd> parts(reinterpret_cast<const double*>(values.data()), 2,
                                                 static_cast<Eigen::Index>(values.size()));
  for (const Eigen::Index part : {0, 1}) {
    const double low = parts.row(part).minCoeff(), high = parts.row(part).maxCoeff();
    const double unit = (high - low) / numbers_in_range, plain = 0.5 * (low + high);
    const double whole = unit > 0.0 ? std::round(plain / unit) * unit : plain;
    const double middle = std::isfinite(whole) ? whole : plain;
    for (std::size_t i = 0; i < values.size() && unit > 0.0; ++i) {
      const double number = std::round((parts(part, static_cast<Eigen::Index>(i)) - middle) / unit);
      numbers[2 * i + static_cast<std::size_t>(part)] =
          static_cast<std::int32_t>(std::clamp(number, -2147483647.0, 2147483647.0));
    }
    scale.insert(scale.end(), {middle, unit});
  }
  return {{"scale", scale}, {"values", base64(numbers)}};
}

struct ModeCurves {
  std::vector<std::vector<PiecewiseCurve>> modes;
  std::size_t bytes = 0;
};

ModeCurves approximate_modes(const LociFile& loci, const std::vector<double>& places, const Closeness& close,
                             std::size_t budget, RootCount& roots) {
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
  CurveOptions options;
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
  RootCount roots{budget.roots};
  for (const PathStep& step : loci.steps) {
    for (const DenseBlock& block : step.blocks)
      roots.most += block.size() > 1 ? budget.roots / share_of_step * block.modes.size() : 0;
  }
  const Closeness* used = nullptr;
  for (const Closeness& close : closeness) {
    used = &close;
    const std::size_t most = used == &closeness.back() ? SIZE_MAX : budget.curves;
    curves = approximate_modes(loci, places, close, most, roots);
    if (curves.bytes <= budget.curves) break;
  }
  Json data{{"closeness", used->share}, {"degree", used->degree}};
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
