#include "parts.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/store/output_file.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {

void add_part(CLI::App& command, std::optional<Part>& part) {
  command.add_option_function<std::string>(
      "--part", [&part](const std::string& text) { part = read_part(text); },
      "i/N: compute part i of N only and write it to a file of its own; eigentrail merge joins the parts");
}

void add_output_flags(CLI::App& command, OutputChoice& output, const std::string& replaced) {
  const auto force = command.add_flag("--force", output.force, replaced);
  command
      .add_flag("--resume", output.resume, "go on with a run that was interrupted; begin where there is none")
      ->excludes(force);
  command.add_flag("-q,--quiet", output.quiet, "no progress bar, no summary");
}

std::unique_ptr<UnfinishedRun> unfinished_run(OutputChoice& output, SharedRun run,
                                              const std::optional<Part>& part, const Team& team) {
  if (part)
    run.settings.emplace_back("--part", std::to_string(part->number) + "/" + std::to_string(part->count));
  const Before before = output.force ? Before::discard : output.resume ? Before::resume : Before::refuse;
  auto unfinished = std::make_unique<UnfinishedRun>(output.path, run, before);
  output.force = output.force || unfinished->goes_on();
  if (team.leads() && !unfinished->other_kernel().empty())
    warn(output.path + ": was computed with another kernel of BLAS (" + unfinished->other_kernel() +
         "); the last digits differ from those of a run on one machine");
  return unfinished;
}

bool has_ended(const OutputChoice& output, const Team& team, const std::function<bool()>& complete) {
  std::error_code not_found;
  if (!output.resume || !std::filesystem::exists(output.path, not_found) || is_unfinished(output.path) ||
      !complete())
    return false;
  if (team.leads() && !output.quiet)
    std::printf("%s: the run has come to its end already\n", output.path.c_str());
  return true;
}

bool has_ended(const OutputChoice& output, const Team& team, const SharedRun& run,
               const std::optional<Part>& part) {
  return has_ended(output, team, [&] {
    if (part)
      require_part(output.path, run, *part);
    else
      require_run(output.path, run);
    return true;
  });
}

int end_run(UnfinishedRun& unfinished, const std::function<int()>& write) try {
  const int code = write();
  unfinished.end();
  return code;
} catch (const InputError&) {
  unfinished.end();
  throw;
}

std::string default_output(const std::string& scene, const std::string& ending,
                           const std::optional<Part>& part) {
  if (!part) return beside(scene, ending + ".h5");
  return beside(
      scene, ending + ".part-" + std::to_string(part->number) + "-of-" + std::to_string(part->count) + ".h5");
}

void check_part_output(const OutputChoice& output) {
  check_output(output.path, output.force, {part_format, "part of a run"});
  check_can_create(output.path);
}

int write_part(const OutputChoice& output, SharedRun run, const Part& part, std::vector<std::string> pieces) {
  const std::size_t computed = pieces.size(), all = run.n_pieces;
  eigentrail::write_part({output.path, std::move(run), part, std::move(pieces)}, existing(output.force));
  if (output.quiet) return done;
  std::printf("wrote %s: part %d of %d, %zu of %zu pieces; eigentrail merge joins the parts\n",
              output.path.c_str(), part.number, part.count, computed, all);
  return done;
}

double number_of(const SharedRun& run, const std::string& label) {
  return std::strtod(run.setting(label).value_or("nan").c_str(), nullptr);
}

}  // namespace eigentrail::app
