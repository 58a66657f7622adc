#include <cmath>
#include <cstdio>
#include <memory>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/stability/boundary.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "scene_arguments.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

struct BoundaryArguments : SceneArguments {
  std::string output;
  bool force = false;
  bool quiet = false;
  BoundaryRequest request;
  std::string from, to;  ///< of the second parameter
  std::optional<std::string> first_from, first_to;
};

/// Reads the ranges, whose numbers may have units.
void read_ranges(const Scene& scene, BoundaryArguments& arguments) {
  BoundaryRequest& request = arguments.request;
  const auto number = [&scene](const std::string& option, const std::string& text, const std::string& name) {
    // An unknown name is reported where the options are checked.
    const auto index = scene.parameters.index(name);
    return read_value(option, text, index ? scene.parameters[static_cast<std::size_t>(*index)] : Parameter{});
  };
  request.from = number("--from", arguments.from, request.second);
  request.to = number("--to", arguments.to, request.second);
  const std::string first = request.parameter.value_or(traced_name(scene));
  if (arguments.first_from) request.first_from = number("--first-from", *arguments.first_from, first);
  if (arguments.first_to) request.first_to = number("--first-to", *arguments.first_to, first);
}

std::string range_text(double from, double to) {
  return rounded(from, 8) + " .. " + rounded(to, 8);
}

std::string ends_text(const BoundaryCurve& curve) {
  if (curve.closed()) return "closed";
  return curve_end_name(curve.begin) + ", " + curve_end_name(curve.end);
}

/// Whether a curve bounds the stable region at all its points, at some or at none, in words.
std::string bounds_text(const BoundaryCurve& curve) {
  std::size_t free = 0;
  for (const BoundaryPoint& point : curve.points) free += point.others == 0 ? 1 : 0;
  return free == curve.points.size() ? "yes" : free == 0 ? "no" : "in part";
}

void print_curves(const BoundaryOptions& options, const BoundaryResult& result) {
  std::vector<std::vector<std::string>> rows{{"curve", "kind", "mode", "points", options.trace.parameter,
                                              options.second, "ends", "bounds the stable region"}};
  for (std::size_t i = 0; i < result.curves.size(); ++i) {
    const BoundaryCurve& curve = result.curves[i];
    const auto [low, high] = curve.extent();
    rows.push_back({std::to_string(i + 1), boundary_name(curve.kind), curve.mode,
                    std::to_string(curve.points.size()), range_text(low[0], high[0]),
                    range_text(low[1], high[1]), ends_text(curve), bounds_text(curve)});
  }
  print_table(rows);
  for (std::size_t i = 0; i < result.curves.size(); ++i) {
    for (const std::string& reason : {result.curves[i].begin_reason, result.curves[i].end_reason}) {
      if (!reason.empty()) std::printf("  curve %zu  %s\n", i + 1, reason.c_str());
    }
  }
}

void print_corners(const BoundaryOptions& options, const BoundaryResult& result) {
  if (result.corners.empty()) return;
  std::vector<std::vector<std::string>> rows{
      {"corner", options.trace.parameter, options.second, "s", "curves"}};
  for (const Corner& corner : result.corners) {
    const auto root = [&corner](std::size_t i) {
      const Complex s = corner.s[i];
      constexpr double rounding = 1e-12;
      return complex_text(std::abs(s.real()) > rounding * std::abs(s) ? s.real() : 0.0, s.imag(), 8);
    };
    rows.push_back({corner_name(corner.kind), rounded(corner.place[0], 12), rounded(corner.place[1], 12),
                    root(0) + ", " + root(1),
                    std::to_string(corner.curves[0] + 1) + ", " + std::to_string(corner.curves[1] + 1)});
  }
  print_table(rows);
}

void print_summary(const BoundarySetup& setup, const BoundaryResult& result) {
  const BoundaryOptions& options = setup.options;
  if (!setup.scene.title.empty()) std::printf("%s\n", printable(setup.scene.title).c_str());
  std::printf("  window  %s %s, %s %s, tolerance %s\n", options.trace.parameter.c_str(),
              range_text(options.trace.from, options.trace.to).c_str(), options.second.c_str(),
              range_text(options.second_from, options.second_to).c_str(),
              rounded(options.trace.tolerance).c_str());
  if (result.curves.empty()) {
    std::printf("  no boundary in the window\n");
  } else {
    print_curves(options, result);
  }
  print_corners(options, result);
  for (const std::string& note : result.notes) std::printf("  note  %s\n", note.c_str());
  std::printf(
      "  work  %d lines traced, %d changes of stability on them, %d extrema followed (%d curves found by "
      "these), %d steps tried again, %s s\n",
      result.lines, result.seeds, result.walks, result.islands, result.rejected_steps,
      rounded(result.seconds, 3).c_str());
}

int run_boundary(BoundaryArguments& arguments) {
  check_output(arguments.output, arguments.force, {boundary_format, "boundary file"});
  Scene scene = given_scene(arguments);
  read_ranges(scene, arguments);
  const BoundarySetup setup = prepare_boundary(std::move(scene), arguments.request);
  warn_of_unused(setup.scene, *setup.model);
  check_boundary_names(setup.scene, setup.options);
  check_can_create(arguments.output);
  ProgressBar progress(arguments.quiet);
  const BoundaryResult result = find_boundaries(
      *setup.model, setup.options, [&progress](double share, int points) { progress.update(share, points); });
  progress.finish();
  if (result.status == BoundaryStatus::no_equilibrium) {
    throw InputError(
        setup.scene.path +
        ": no line of the window could be begun; choose another range, or another starting position; " +
        result.message);
  }
  write_boundaries(arguments.output, setup, result);
  if (!arguments.quiet) {
    print_summary(setup, result);
    std::printf("wrote %s\n", arguments.output.c_str());
  }
  if (result.status == BoundaryStatus::completed) return done;
  std::fprintf(stderr, "eigentrail: %s; what was found is in %s\n", result.message.c_str(),
               arguments.output.c_str());
  return numbers_failed;
}

}  // namespace

void add_boundary(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<BoundaryArguments>();
  BoundaryRequest& request = arguments->request;
  CLI::App* command = program.add_subcommand(
      "boundary", "stability boundaries in two parameters: flutter, divergence, or a damping ratio");
  add_scene(*command, *arguments);
  auto* output = command->add_option("-o,--output", arguments->output,
                                     "boundary file to write (HDF5); default: SCENE_boundary.h5, here");
  command->add_option("--second", request.second, "name of the second parameter")->required();
  command->add_option("--from", arguments->from, "where its range begins, in its unit")->required();
  command->add_option("--to", arguments->to, "where its range ends")->required();
  command->add_option("--parameter", request.parameter, "name of the first parameter (overrides the scene)");
  command->add_option("--first-from", arguments->first_from,
                      "where the range of the first parameter begins, in its unit (overrides the scene)");
  command->add_option("--first-to", arguments->first_to, "where it ends (overrides the scene)");
  command->add_option(
      "--tolerance", request.tolerance,
      "bound of the relative error of the eigenvalue and of the curve in units of the window, "
      "everywhere along it (overrides the scene)");
  command->add_option("--damping-ratio", request.damping_ratio,
                      "follow this damping ratio instead of flutter and divergence, between -1 and 1");
  command->add_option(
      "--lines", request.lines,
      "inner lines of the window that are searched in either direction, beside its edges (5)");
  command->add_flag("--force", arguments->force, "replace an existing output");
  command->add_flag("-q,--quiet", arguments->quiet, "no progress bar, no summary");
  command->footer(
      "Example:\n"
      "  eigentrail boundary data/scenes/rotating_mass.toml --second a_n --from 200 --to 3000 -o flutter.h5");
  command->callback([arguments, output, &exit_code] {
    if (output->count() == 0) arguments->output = beside(arguments->scene, "_boundary.h5");
    exit_code = run_boundary(*arguments);
  });
}

}  // namespace eigentrail::app
