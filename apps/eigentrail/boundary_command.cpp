#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/stability/boundary.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "output.hpp"
#include "scene_arguments.hpp"
#include "shared_job.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

struct BoundaryArguments : PlaneArguments {
  OutputChoice output;
  BoundaryRequest request;
};

/// Reads the ranges, whose numbers may have units.
void read_ranges(const Scene& scene, BoundaryArguments& arguments) {
  BoundaryRequest& request = arguments.request;
  request.second = arguments.second;
  std::tie(request.from, request.to) = arguments.second_range(scene);
  const Parameter first = parameter_called(scene, arguments.traced(scene));
  for (const std::string key : {"from", "to"}) {
    const auto given = arguments.options.find(key);
    if (given != arguments.options.end())
      given->second = exact_text(read_value("--" + key, given->second, first));
  }
  request.overrides = arguments.overrides();
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
    rows.push_back({corner_name(corner.kind), rounded(corner.place[0], 12), rounded(corner.place[1], 12),
                    eigenvalue_text(corner.s[0], 8) + ", " + eigenvalue_text(corner.s[1], 8),
                    std::to_string(corner.curves[0] + 1) + ", " + std::to_string(corner.curves[1] + 1)});
  }
  print_table(rows);
}

void print_summary(const BoundarySetup& setup, const BoundaryResult& result) {
  const BoundaryOptions& options = setup.options;
  print_title(setup.scene.title);
  std::printf("  window  %s %s, %s %s, tolerance %s\n", options.trace.parameter.c_str(),
              range_text(options.trace.from, options.trace.to).c_str(), options.second.c_str(),
              range_text(options.second_from, options.second_to).c_str(),
              rounded(options.trace.tolerance).c_str());
  if (result.curves.empty()) {
    std::printf("  no boundary %s the window\n", result.notes.empty() ? "in" : "was followed in");
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

/// Follows the boundaries from what was found on all lines, writes them and prints a summary.
int finish_boundary(const BoundarySetup& setup, const SharedRun& run, const ComputedRun& scans,
                    const OutputChoice& output) {
  ProgressBar progress(output.quiet);
  BoundaryResult result =
      follow_boundaries(*setup.model, setup.options, scans.pieces, scans.workers,
                        [&progress](double share, int points) { progress.update(share, points); });
  progress.finish();
  result.seconds += scans.seconds.value_or(0.0);
  if (!scans.leads) return done;
  if (result.status == BoundaryStatus::no_equilibrium) {
    throw InputError(
        setup.scene.path +
        ": no line of the window could be begun; choose another range, or another starting position; " +
        result.message);
  }
  write_result(output, run, boundary_file(setup, result), [&] { print_summary(setup, result); });
  if (result.status == BoundaryStatus::completed) return done;
  std::fprintf(stderr, "eigentrail: %s; what was found is in %s\n", result.message.c_str(),
               output.path.c_str());
  return numbers_failed;
}

SharedRun shared_run(const BoundarySetup& setup, const BoundaryRequest& request) {
  SharedRun run{"boundary", setup.scene.path, settings_of(setup.scene), boundary_lines(setup.options)};
  run.settings.insert(run.settings.end(), {{"--second", request.second},
                                           {"--second-from", exact_text(request.from)},
                                           {"--second-to", exact_text(request.to)}});
  std::map<std::string, std::string> given(request.overrides.begin(), request.overrides.end());
  if (request.damping_ratio) given["damping-ratio"] = exact_text(*request.damping_ratio);
  if (request.lines) given["lines"] = std::to_string(*request.lines);
  for (const std::string key : {"from", "to", "tolerance", "damping-ratio", "parameter", "lines"}) {
    if (given.contains(key)) run.settings.emplace_back("--" + key, given[key]);
  }
  return run;
}

SharedJob boundary_job(std::shared_ptr<const BoundarySetup> setup, SharedRun run,
                       const OutputChoice& output) {
  SharedJob job{std::move(run), hdf5_format(boundary_format, "boundary file")};
  job.compute = [setup](const std::vector<std::size_t>& lines, Workers& workers, ProgressBar& progress) {
    return scan_boundaries(*setup->model, setup->options, lines, workers,
                           [&progress](double share, int points) { progress.update(share, points); });
  };
  job.finish = [setup, run = job.run, &output](const ComputedRun& scans) {
    return finish_boundary(*setup, run, scans, output);
  };
  return job;
}

int run_boundary(BoundaryArguments& arguments, Team& team) {
  arguments.output.name_like(arguments.scene, "_boundary", ".h5");
  Scene scene = given_scene(arguments);
  read_ranges(scene, arguments);
  const auto setup =
      std::make_shared<const BoundarySetup>(prepare_boundary(std::move(scene), arguments.request));
  warn_of_unused(setup->scene, *setup->model);
  check_boundary_names(*setup);
  return carry_out(boundary_job(setup, shared_run(*setup, arguments.request), arguments.output),
                   arguments.output, team);
}

}  // namespace

SharedJob boundary_of_parts(const SharedRun& run, const OutputChoice& output) {
  BoundaryRequest request;
  request.second = run.setting("--second").value_or("");
  request.from = number_of(run, "--second-from");
  request.to = number_of(run, "--second-to");
  for (const std::string key : {"from", "parameter", "to", "tolerance"}) {
    if (const auto text = run.setting("--" + key)) request.overrides.emplace_back(key, *text);
  }
  if (run.setting("--damping-ratio")) request.damping_ratio = number_of(run, "--damping-ratio");
  if (run.setting("--lines")) request.lines = static_cast<int>(number_of(run, "--lines"));
  Scene scene = parse_scene(run.setting("scene").value_or(""), run.scene_path);
  // The curves are computed from the files beside the scene, which must be those of the lines.
  const auto files = settings_of(scene).back();
  if (run.setting(files.first) != files.second)
    throw InputError(run.scene_path +
                     ": the files that the scene names have changed since the parts were "
                     "computed; restore them, or repeat the parts");
  return boundary_job(std::make_shared<const BoundarySetup>(prepare_boundary(std::move(scene), request)), run,
                      output);
}

void add_boundary(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<BoundaryArguments>(
      program, exit_code, in_team(run_boundary, together), "boundary",
      "stability boundaries in two parameters: flutter, divergence, or a damping ratio");
  BoundaryRequest& request = arguments->request;
  add_scene(*command, *arguments);
  add_output(*command, arguments->output, "boundary file to write (HDF5); default: SCENE_boundary.h5, here");
  add_part(*command, arguments->output);
  add_plane(*command, *arguments);
  add_override(*command, *arguments, "parameter", "name of the first parameter");
  command->add_option_function<double>(
      "--tolerance",
      [&options = arguments->options](double tolerance) { options["tolerance"] = exact_text(tolerance); },
      "bound of the relative error of the eigenvalue and of the curve in units of the window, "
      "everywhere along it (overrides the scene)");
  command->add_option("--damping-ratio", request.damping_ratio,
                      "follow this damping ratio instead of flutter and divergence, between -1 and 1");
  command->add_option(
      "--lines", request.lines,
      "inner lines of the window that are searched in either direction, beside its edges (5)");
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n"
      "  eigentrail boundary data/scenes/rotating_mass.toml --second a_n --second-from 200 --second-to 3000 "
      "-o flutter.h5");
}

}  // namespace eigentrail::app
