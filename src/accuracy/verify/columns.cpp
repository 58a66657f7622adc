// What a file says twice: labels and eigenvalues by its dense output, and columns that follow from others.
#include <algorithm>
#include <cmath>

#include "accuracy/spectrum_distance.hpp"
#include "accuracy/verify/comparisons.hpp"
#include "core/hdf5_file.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// Rounding of an eigenvalue that is stored twice, relative to max(|s|, reference), with a margin.
constexpr double rounding_of_eigenvalue = 1e-9;
/// The same where eigenvalues meet: a root of it.
constexpr double rounding_at_meeting = 1e-4;

/// Distance of two eigenvalues; both may be infinite.
double distance_between(Complex a, Complex b) {
  return std::isinf(a.real()) && std::isinf(b.real()) ? 0.0 : std::abs(a - b);
}

struct Column {
  const char* name;
  double (*of)(Complex s);
};

constexpr Column derived_columns[] = {
    {"frequency", [](Complex s) { return std::abs(s); }},
    {"damped_frequency", [](Complex s) { return std::abs(s.imag()); }},
    {"damping_ratio", [](Complex s) { return std::isinf(std::abs(s)) ? 0.0 : -s.real() / std::abs(s); }},
};

/// Equal but for rounding; two numbers that are no numbers are equal.
bool same_but_rounding(double a, double b) {
  constexpr double rounding = 1e-13;
  return (std::isnan(a) && std::isnan(b)) || a == b ||
         std::abs(a - b) <= rounding * std::max({std::abs(a), std::abs(b), 1e-300});
}

/// The slope of the dense output of a mode that is a block of its own, in p, at an end of a step; of a pair
/// for the member with Im s > 0.
Complex slope_of(const DenseBlock& block, const PathStep& step, bool at_left) {
  const ComplexMatrix& series = at_left ? block.left : block.right;
  const Complex s = chart_value(series(0, 0), block.chart);
  const Complex along = series(0, 1) / step.parameter(at_left ? 0 : 1, 1);
  const Complex slope = block.chart == Chart::finite ? along : -along * s * s;
  return s.imag() < 0.0 ? std::conj(slope) : slope;
}

void compare_derivatives(const CheckedFile& file, const std::vector<Complex>& stored, Comparison& result) {
  constexpr double close = 1e-6;  // relative, and of the eigenvalue over the length of the step
  const LociFile& loci = file.loci;
  for (std::size_t i = 0; i < loci.steps.size(); ++i) {
    for (const DenseBlock& block : loci.steps[i].blocks) {
      if (block.size() > 1 || block.modes.empty()) continue;
      for (const bool at_left : {true, false}) {
        const std::size_t node = at_left ? i : i + 1;
        const Complex slope = slope_of(block, loci.steps[i], at_left);
        const Complex given = stored[node * loci.modes.size() + static_cast<std::size_t>(block.modes[0])];
        // Neither is known where eigenvalues meet, at infinity, and where the path is vertical.
        if (!std::isfinite(std::abs(slope)) || std::isnan(given.real()) || file.is_meeting(node)) continue;
        const double length = std::max(std::abs(loci.p[i + 1] - loci.p[i]), 1e-300);
        const double size = file.scale_of(loci.eigenvalues(static_cast<Eigen::Index>(node), block.modes[0]));
        if (std::abs(given - slope) <= close * (std::abs(slope) + size / length)) continue;
        result.faults.push_back("eigenvalue_derivative of " + file.mode_at(block.modes[0], loci.p[node]) +
                                " is not the slope of the dense output");
      }
    }
  }
}

}  // namespace

Comparison compare_labels(const CheckedFile& file) {
  const LociFile& loci = file.loci;
  Comparison result;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < loci.steps.size(); ++i) {
    const PathStep& step = loci.steps[i];
    const ComplexVector left = loci.eigenvalues_at(PathPosition{i, 0.0});
    const ComplexVector right = loci.eigenvalues_at(PathPosition{i, 1.0});
    for (const double t : {0.0, 1.0}) {
      // Blocks are followed from the end at which their eigenvalues are farther apart, so that one of the
      // two compares both ends.
      const ComplexVector dense = step_eigenvalues(step, left, right, t);
      const ComplexVector& stored = t == 0.0 ? left : right;
      const bool meets = file.is_meeting(t == 0.0 ? i : i + 1);
      const Vector errors = eigenvalue_errors(
          loci, {i, t}, stored, meets ? rounding_at_meeting : rounding_of_eigenvalue, file.accuracy);
      for (const DenseBlock& block : step.blocks) {
        for (const int mode : block.modes) {
          if (std::isnan(stored[mode].real())) continue;  // the mode begins or ends there
          ++compared;
          const double rounding = 2.0 * loci.rounding_at(t == 0.0 ? i : i + 1, mode);  // of both of them
          if (distance_between(dense[mode], stored[mode]) <= std::max(errors[mode], rounding)) continue;
          const double p = t == 0.0 ? loci.p[i] : loci.p[i + 1];
          result.faults.push_back("the stored eigenvalue of " + file.mode_at(mode, p) +
                                  " is not that of the dense output on the step " +
                                  (t == 0.0 ? "behind" : "before") + " it");
        }
      }
    }
  }
  result.compared = count_of(compared, "end") + " of the dense output against the stored eigenvalues";
  return result;
}

Comparison compare_columns(const CheckedFile& file) {
  const LociFile& loci = file.loci;
  const Hdf5File stored = Hdf5File::open(loci.path);
  Comparison result;
  const std::size_t n_modes = loci.modes.size();
  for (const Column& column : derived_columns) {
    const std::vector<double> values = stored.read_real(column.name);
    if (values.size() != loci.n_nodes() * n_modes)
      throw InputError(loci.path + ": " + column.name + " does not fit the other datasets");
    result.compared += (result.compared.empty() ? "" : ", ") + std::string(column.name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto node = static_cast<Eigen::Index>(i / n_modes);
      const auto mode = static_cast<Eigen::Index>(i % n_modes);
      const double expected = column.of(loci.eigenvalues(node, mode));
      if (same_but_rounding(values[i], expected)) continue;
      result.faults.push_back(std::string(column.name) + " of " +
                              file.mode_at(mode, loci.p[static_cast<std::size_t>(node)]) + " is " +
                              exact_text(values[i]) + ", by its eigenvalue " + exact_text(expected));
    }
  }
  const std::vector<Complex> derivatives = stored.read_complex("eigenvalue_derivative");
  if (derivatives.size() != loci.n_nodes() * n_modes)
    throw InputError(loci.path + ": eigenvalue_derivative does not fit the other datasets");
  compare_derivatives(file, derivatives, result);
  result.compared += " and eigenvalue_derivative against the eigenvalues";
  return result;
}

}  // namespace eigentrail
