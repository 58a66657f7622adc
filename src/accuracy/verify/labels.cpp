#include <algorithm>
#include <cmath>

#include "accuracy/spectrum_distance.hpp"
#include "accuracy/verify/comparisons.hpp"

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
          if (distance_between(dense[mode], stored[mode]) <= errors[mode]) continue;
          const double p = t == 0.0 ? loci.p[i] : loci.p[i + 1];
          result.faults.push_back("the stored eigenvalue of " + file.mode_at(mode, p) +
                                  " is not that of the dense output on the step " +
                                  (t == 0.0 ? "behind" : "before") + " it");
        }
      }
    }
  }
  result.compared = count_text(compared, "end") + " of the dense output against the stored eigenvalues";
  return result;
}

}  // namespace eigentrail
