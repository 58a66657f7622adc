#include "eigentrail/stability/boundary_options.hpp"
#include "eigentrail/projection/project.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "eigentrail/continuation/event_options.hpp"
#include "eigentrail/core/text.hpp"
#include "stability/second_parameter.hpp"

namespace eigentrail {
namespace {

/// Number of values of each parameter at which masses, lengths and the direction of gravity are checked.
constexpr int checked_points = 9;

void check_numbers(const BoundaryOptions& options) {
  if (options.lines < 0 || options.lines > 1000)
    throw InputError("--lines: must lie between 0 and 1000; found " + std::to_string(options.lines));
  if (options.damping_ratio && !(std::abs(*options.damping_ratio) < 1.0))
    throw InputError("--damping-ratio: must lie between -1 and 1; found " +
                     exact_text(*options.damping_ratio));
}

}  // namespace

BoundarySetup prepare_boundary(Scene scene, const BoundaryRequest& request) {
  check_top_level(scene);
  require_first_range(scene, request.overrides);
  BoundarySetup setup{std::move(scene), {}, nullptr};
  BoundaryOptions& options = setup.options;
  std::set<int> used;
  options.trace = read_trace_options(setup.scene, request.overrides, used);
  options.second = request.second;
  check_second_range(request.from, request.to);
  std::tie(options.second_from, options.second_to) = std::minmax(request.from, request.to);
  const std::vector<double> ratios = options.trace.events.values(EventKind::damping_ratio);
  if (!request.damping_ratio && ratios.size() > 1)
    throw InputError("--damping-ratio: the scene's [events] has " + std::to_string(ratios.size()) +
                     " damping ratios; choose one of them here, or 0 for the imaginary axis");
  options.damping_ratio = request.damping_ratio;
  if (!options.damping_ratio && !ratios.empty()) options.damping_ratio = ratios.front();
  // A damping ratio of zero is the imaginary axis: flutter and divergence.
  if (options.damping_ratio == 0.0) options.damping_ratio.reset();
  options.lines = request.lines.value_or(options.lines);
  check_second_parameter(setup.scene, options.second, options.trace.parameter);
  check_numbers(options);
  setup.model =
      model_over_window(setup.scene, options.trace, {options.second, options.second_from, options.second_to},
                        used, checked_points);
  for (const int unused : setup.model->description().unused_parameters) {
    const std::string& name = setup.scene.parameters[static_cast<std::size_t>(unused)].name;
    if (name == options.trace.parameter || name == options.second) throw unused_error(setup.scene, unused);
  }
  project_if_large(setup.model, options.trace,
                   lines_over(options.trace, options.second, options.second_from, options.second_to));
  return setup;
}

}  // namespace eigentrail
