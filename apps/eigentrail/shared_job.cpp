#include "shared_job.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/store/unfinished_run.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

const OutputFormat part_of_a_run{"part of a run",
                                 [](const std::string& path) { return begins_with(path, pieces_format); }};

/// Whether --resume has nothing to do: the output, or this part of it, is complete, which is then said.
/// Throws InputError if it is of another run.
bool has_ended(const SharedJob& job, const OutputChoice& output, const Team& team) {
  std::error_code not_found;
  if (!output.resume || !std::filesystem::exists(output.path, not_found) || is_unfinished(output.path))
    return false;
  if (!output.part && job.is_whole) {
    if (!job.is_whole()) return false;
  } else {
    require_run(output.path, job.run);
  }
  if (team.leads() && !output.quiet)
    std::printf("%s: the run has come to its end already\n", output.path.c_str());
  return true;
}

/// Ends a run whose pieces have all been computed: `write` writes the output and returns the exit code. What
/// was saved of the run stays if the output cannot be written, and goes if there is none for this input.
int end_run(UnfinishedRun& unfinished, const std::function<int()>& write) try {
  const int code = write();
  unfinished.end();
  return code;
} catch (const InputError&) {
  unfinished.end();
  throw;
}

/// Writes a part with a note on what to do next.
int finish_part(const OutputChoice& output, const SharedRun& run, UnfinishedRun& unfinished) {
  unfinished.write_part(output.existing());
  if (!output.quiet)
    std::printf("wrote %s: part %d of %d, %zu of %zu pieces; eigentrail merge joins the parts\n",
                output.path.c_str(), run.part->number, run.part->count, run.pieces().size(), run.n_pieces);
  return done;
}

/// What a run that writes an output, which is checked, has left, and the pieces of parts that are joined;
/// null for other runs. Says on the process that leads where it was computed with another kernel of BLAS.
std::unique_ptr<UnfinishedRun> saved_pieces(const SharedJob& job, OutputChoice& output, const Team& team) {
  if (!job.writes) return nullptr;
  const Before before = output.force ? Before::discard : output.resume ? Before::resume : Before::refuse;
  auto unfinished = std::make_unique<UnfinishedRun>(output.path, job.run, before);
  unfinished->take(job.known);
  output.force = output.force || unfinished->goes_on();
  if (!team.leads()) return unfinished;
  if (!unfinished->other_kernel().empty())
    warn(output.path + ": was computed with another kernel of BLAS (" + unfinished->other_kernel() +
         "); the last digits differ from those of a run on one machine");
  if (job.check_more_files) job.check_more_files();
  check_new_output(output.path, output.force, output.part ? part_of_a_run : job.format);
  return unfinished;
}

}  // namespace

int carry_out(SharedJob job, OutputChoice& output, Team& team) {
  job.run.part = output.part;
  if (job.writes && has_ended(job, output, team)) return done;
  const auto unfinished = saved_pieces(job, output, team);
  // All processes of the team meet here: none looks any more for what an earlier run has left.
  std::unique_ptr<Workers> workers = team.workers(job.jobs);
  if (unfinished && job.check_more_files && team.leads()) unfinished->begin();
  if (unfinished) workers = std::make_unique<SavingWorkers>(std::move(workers), *unfinished);
  const std::vector<std::size_t> numbers = job.run.pieces();
  ProgressBar progress(output.quiet);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::string> pieces = job.compute(numbers, *workers, progress);
  progress.finish();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto finish = [&]() -> int {
    if (!output.part)
      return job.finish(
          {pieces, job.known.empty() ? std::optional(seconds) : std::nullopt, *workers, team.leads()});
    return team.leads() ? finish_part(output, job.run, *unfinished) : done;
  };
  return unfinished && team.leads() ? end_run(*unfinished, finish) : finish();
}

void write_result(const OutputChoice& output, const SharedRun& run, const std::string& bytes,
                  const std::function<void()>& print) {
  write_durably(output.path, {bytes, run_mark(run)}, output.existing());
  if (output.quiet) return;
  print();
  std::printf("wrote %s\n", output.path.c_str());
}

double number_of(const SharedRun& run, const std::string& label) {
  return std::strtod(run.setting(label).value_or("nan").c_str(), nullptr);
}

}  // namespace eigentrail::app
