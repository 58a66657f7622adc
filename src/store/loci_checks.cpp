#include "store/loci_checks.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// Whether a point is a branch point, at which a trace may take another path: each path knows it only to half
/// of the digits.
bool is_branch_point(const LociFile& loci, std::size_t node) {
  return std::any_of(loci.events.begin(), loci.events.end(), [&](const LociEvent& event) {
    return event.kind == "branch_point" && event.node == static_cast<int>(node);
  });
}

void check_ends(const LociFile& loci, std::size_t step) {
  constexpr double rounding = 1e-12;
  constexpr double half_of_digits = 1e-8;
  const double size = loci.highest() - loci.lowest() + std::abs(loci.highest());
  const PathStep& here = loci.steps[step];
  for (const std::size_t end : {0, 1}) {
    const double expected = here.parameter(static_cast<Eigen::Index>(end), 0);
    const double p = loci.p[step + end];
    const double allowed = is_branch_point(loci, step + end) ? half_of_digits : rounding;
    if (std::abs(expected - p) <= allowed * size) continue;
    throw InputError(loci.path + ": point " + std::to_string(step + end + 1) + " has " + loci.parameter +
                     " = " + exact_text(p) + ", the step " + (end == 0 ? "behind" : "before") +
                     " it step_parameter = " + exact_text(expected));
  }
  if (follows_parameter(here) && !((loci.p[step + 1] - loci.p[step]) * here.length > 0.0))
    throw InputError(loci.path + ": " + loci.parameter + " goes from " + exact_text(loci.p[step]) + " to " +
                     exact_text(loci.p[step + 1]) + " on a step whose step_length is " +
                     exact_text(here.length));
}

/// Whether each mode exists on a step.
std::vector<bool> modes_on(const LociFile& loci, std::size_t step) {
  std::vector<bool> exist(loci.modes.size(), false);
  for (const DenseBlock& block : loci.steps[step].blocks) {
    for (const int mode : block.modes) exist[static_cast<std::size_t>(mode)] = true;
  }
  return exist;
}

/// At an end of the trace, the side without a step does not count.
void check_existence(const LociFile& loci) {
  std::vector<bool> before(loci.modes.size(), true);
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    const std::vector<bool> behind =
        node < loci.steps.size() ? modes_on(loci, node) : std::vector<bool>(loci.modes.size(), true);
    for (std::size_t mode = 0; mode < loci.modes.size(); ++mode) {
      const Complex s = loci.eigenvalues(static_cast<Eigen::Index>(node), static_cast<Eigen::Index>(mode));
      if (!before[mode] || !behind[mode] || (!std::isnan(s.real()) && !std::isnan(s.imag()))) continue;
      throw InputError(loci.path + ": eigenvalue of " + loci.modes[mode] + " at " + loci.parameter + " = " +
                       exact_text(loci.p[node]) + " is nan, where the mode exists beside it");
    }
    before = behind;
  }
}

}  // namespace

void check_points_and_steps(const LociFile& loci) {
  for (std::size_t step = 0; step < loci.steps.size(); ++step) check_ends(loci, step);
  if (!loci.steps.empty()) check_existence(loci);
}

}  // namespace eigentrail
