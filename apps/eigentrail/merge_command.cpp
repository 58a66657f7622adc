#include <algorithm>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "scene_arguments.hpp"
#include "shared_job.hpp"

namespace eigentrail::app {
namespace {

struct MergeArguments {
  std::vector<std::string> files;
  OutputChoice output;
};

int run_merge(MergeArguments& arguments, Team& team) {
  std::vector<PartFile> parts;
  for (const std::string& file : arguments.files) parts.push_back(read_part_file(file));
  PiecesByName pieces = joined(parts);
  const PartFile& first = parts.front();
  SharedRun run = first.run;
  run.part.reset();
  const auto other = std::ranges::find_if(
      parts, [&first](const PartFile& part) { return part.blas_kernel != first.blas_kernel; });
  if (other != parts.end() && team.leads())
    warn(other->path + ": was computed with the kernel " + other->blas_kernel + " of BLAS, " + first.path +
         " with " + first.blas_kernel + "; the last digits differ from those of a run on one machine");
  for (const auto& [command, job_of_parts] :
       {std::pair{"map", &map_of_parts}, {"boundary", &boundary_of_parts}, {"sweep", &sweep_of_parts}}) {
    if (run.command != command) continue;
    SharedJob job = job_of_parts(run, arguments.output);
    job.known = std::move(pieces);
    return carry_out(std::move(job), arguments.output, team);
  }
  throw InputError(first.path + ": is a part of '" + run.command + "', which this version cannot join");
}

}  // namespace

void add_merge(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<MergeArguments>(
      program, exit_code, in_team(run_merge, together), "merge",
      "join the parts of a map, boundary or sweep that were computed with --part");
  command->add_option("FILES", arguments->files, "the files of all parts, in any order")->required();
  add_output(*command, arguments->output, "file to write")->required();
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n"
      "  eigentrail merge part_1.h5 part_2.h5 -o drag.h5\n\n"
      "The parts come from the same command with --part 1/2 -o part_1.h5 and --part 2/2 -o part_2.h5.");
}

}  // namespace eigentrail::app
