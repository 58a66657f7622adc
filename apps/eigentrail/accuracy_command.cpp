#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/accuracy/study.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "output.hpp"
#include "scene_arguments.hpp"
#include "shared_job.hpp"

namespace eigentrail::app {
namespace {

bool by_trace(const MeasuredRun& run) {
  return run.method == Method::trace || run.method == Method::trace_uncertified;
}

bool measured(const MeasuredRun& run) {
  return run.completed && run.measured > 0;
}

std::string error_text(const MeasuredRun& run) {
  if (!run.completed) return "ended early";
  return run.measured > 0 ? rounded(run.error, 2) : "not measured";
}

std::string milliseconds(double seconds) {
  return rounded(1e3 * seconds, 3) + " ms";
}

std::string remark(const MeasuredRun& run, bool own) {
  return run.method == Method::trace_uncertified ? "no certificate" : own ? "as the scene says" : "";
}

void print_traces(const std::vector<MeasuredRun>& runs) {
  // The run with the scene's own options is the last one with certificate. The run without certificate is
  // after it.
  const MeasuredRun* own = nullptr;
  for (const MeasuredRun& run : runs) own = run.method == Method::trace ? &run : own;
  std::vector<std::vector<std::string>> rows{
      {"order", "tolerance", "error", "error/tolerance", "points", "LU", "evaluations", "time", "file"}};
  for (const MeasuredRun& run : runs) {
    if (!by_trace(run)) continue;
    rows.push_back({std::to_string(run.order), exact_text(run.tolerance), error_text(run),
                    measured(run) ? rounded(run.error / run.tolerance, 2) : "", std::to_string(run.points),
                    std::to_string(run.factorizations), std::to_string(run.evaluations),
                    milliseconds(run.seconds), rounded(1e-6 * static_cast<double>(run.bytes), 3) + " MB",
                    remark(run, &run == own)});
  }
  print_table(rows);
}

/// Prints one row per grid, with the errors of both interpolations. The run with the spline follows the one
/// with linear interpolation in the list.
void print_rivals(const std::vector<MeasuredRun>& runs) {
  std::vector<std::vector<std::string>> rows{
      {"instead, on a grid", "points", "error, linear", "spline", "LU", "QZ", "evaluations", "time"}};
  for (auto run = runs.begin(); run != runs.end(); ++run) {
    if (run->interpolation != Interpolation::linear) continue;
    rows.push_back({method_name(run->method), std::to_string(run->points), error_text(*run),
                    error_text(*std::next(run)), std::to_string(run->factorizations),
                    std::to_string(run->spectra), std::to_string(run->evaluations),
                    milliseconds(run->seconds)});
  }
  if (rows.size() == 1) return;
  std::printf(
      "  times of traces include the certificate, lost modes and special points; those below have none of "
      "them\n");
  print_table(rows);
}

/// The fastest of the runs that `choose` accepts and whose error is at most `bound`; null if there is none.
template <class Choose>
const MeasuredRun* fastest(const std::vector<MeasuredRun>& runs, double bound, Choose choose) {
  const MeasuredRun* best = nullptr;
  for (const MeasuredRun& run : runs) {
    if (!choose(run) || !measured(run) || run.error > bound) continue;
    if (best == nullptr || run.seconds < best->seconds) best = &run;
  }
  return best;
}

std::string cost_text(const MeasuredRun* run) {
  if (run == nullptr) return "none of those tried";
  const std::string setting = run->method == Method::trace ? "order " + std::to_string(run->order) + " at " +
                                                                 exact_text(run->tolerance)
                                                           : run_name(*run);
  return setting + ": " + std::to_string(run->points) + " points, " + milliseconds(run->seconds);
}

/// The tolerances of the traces with certificate, the largest first.
std::set<double, std::greater<>> tolerances_of(const std::vector<MeasuredRun>& runs) {
  std::set<double, std::greater<>> tolerances;
  for (const MeasuredRun& run : runs) {
    if (run.method == Method::trace) tolerances.insert(run.tolerance);
  }
  return tolerances;
}

/// Prints for each tolerance the fastest trace that had this tolerance or a smaller one and achieved it, and
/// the fastest run on a grid that achieved it.
void print_advice(const std::vector<MeasuredRun>& runs) {
  const auto is_rival = [](const MeasuredRun& run) { return !by_trace(run); };
  const bool rivals = std::ranges::any_of(runs, is_rival);
  std::vector<std::vector<std::string>> rows{{"error below", "fastest trace"}};
  if (rivals) rows[0].emplace_back("fastest instead");
  for (const double bound : tolerances_of(runs)) {
    const auto promised = [bound](const MeasuredRun& run) {
      return run.method == Method::trace && run.tolerance <= bound;
    };
    rows.push_back({exact_text(bound), cost_text(fastest(runs, bound, promised))});
    if (rivals) rows.back().push_back(cost_text(fastest(runs, bound, is_rival)));
  }
  print_table(rows);
}

/// The order that was the fastest at the largest number of tolerances; 0 if there are no measured traces.
int best_order(const std::vector<MeasuredRun>& runs) {
  std::vector<int> wins(8, 0);
  for (const double tolerance : tolerances_of(runs)) {
    const MeasuredRun* best = fastest(runs, INFINITY, [&](const MeasuredRun& run) {
      return run.method == Method::trace && run.tolerance == tolerance;
    });
    if (best != nullptr) ++wins[static_cast<std::size_t>(best->order)];
  }
  return static_cast<int>(std::ranges::max_element(wins) - wins.begin());
}

/// Prints the cost of the certificate: the run with the scene's own options compared with the next one in the
/// list, which has the same options without certificate.
void print_cost_of_certificate(const std::vector<MeasuredRun>& runs) {
  const auto without = std::ranges::find_if(
      runs, [](const MeasuredRun& run) { return run.method == Method::trace_uncertified; });
  if (without == runs.end() || without == runs.begin()) return;
  const MeasuredRun& with = *std::prev(without);
  const double share = (with.seconds - without->seconds) / with.seconds;
  std::printf(
      "; the certificate costs %s of the time at tolerance %s and order %d (%llu LU with it, %llu without)",
      share > 0.0 ? percent(share, 2).c_str() : "less than the noise", exact_text(with.tolerance).c_str(),
      with.order, static_cast<unsigned long long>(with.factorizations),
      static_cast<unsigned long long>(without->factorizations));
}

void print_conclusions(const std::vector<MeasuredRun>& runs) {
  const auto traces = std::ranges::count_if(runs, by_trace);
  const auto kept = std::ranges::count_if(runs, [](const MeasuredRun& run) {
    return by_trace(run) && measured(run) && run.error <= run.tolerance;
  });
  std::printf("  %td of %td traces kept their tolerance", kept, traces);
  if (const int order = best_order(runs); order > 0)
    std::printf("; order %d was the fastest at most tolerances", order);
  print_cost_of_certificate(runs);
  std::printf(".\n");
}

void print_reference(const ReferenceSet& reference, const std::string& parameter) {
  std::printf(
      "  errors over %zu values of %s, against eigenvalues computed with 113 bits; last correction of these "
      "%s\n",
      reference.samples.size(), parameter.c_str(), rounded(reference.correction, 2).c_str());
  if (reference.unsolved > 0)
    std::printf("  note  no reference at %d more: beyond the end of the path, or singular there\n",
                reference.unsolved);
}

/// Prints the number and the error of the references, tables of all runs, and conclusions.
void print_study(const TraceSetup& setup, const Study& study) {
  print_title(setup.scene.title);
  print_reference(study.reference, setup.options.parameter);
  print_traces(study.runs);
  print_rivals(study.runs);
  print_advice(study.runs);
  print_conclusions(study.runs);
}

struct AccuracyArguments : SceneArguments {
  OutputChoice output;
  std::map<std::string, std::string> lists;  ///< per flag: the list of numbers as text
  StudyOptions study;
};

/// Reads numbers separated by commas; "none" is the empty list. `numbers` keeps its value if the flag was not
/// given.
template <class Number>
void read_list(const AccuracyArguments& arguments, const std::string& flag, std::vector<Number>& numbers) {
  const auto given = arguments.lists.find(flag);
  if (given == arguments.lists.end()) return;
  const std::string& text = given->second;
  numbers.clear();
  if (text == "none") return;
  for (const std::string& part : split(text, ',')) {
    const auto number = parsed_number<Number>(part);
    if (!number) throw InputError(flag + ": expected numbers separated by commas; found '" + text + "'");
    numbers.push_back(*number);
  }
}

/// What the study depends on.
SharedRun shared_run(const TraceSetup& setup, const AccuracyArguments& arguments) {
  SharedRun run{"accuracy", setup.scene.path, settings_of(setup.scene)};
  run.settings.insert(run.settings.end(), arguments.lists.begin(), arguments.lists.end());
  run.settings.emplace_back("--samples", std::to_string(arguments.study.samples));
  run.settings.emplace_back("--repeat", std::to_string(arguments.study.repeat));
  for (const auto& [key, text] : arguments.options) run.settings.emplace_back("--" + key, text);
  return run;
}

int finish_study(const TraceSetup& setup, const AccuracyArguments& arguments, const SharedJob& job,
                 const Study& study) {
  const OutputChoice& output = arguments.output;
  if (study.reference.samples.empty()) {
    std::fprintf(stderr, "eigentrail: %s: no reference could be computed anywhere on the range\n",
                 setup.scene.path.c_str());
    return numbers_failed;
  }
  if (!output.quiet) print_study(setup, study);
  if (job.writes) write_result(output, job.run, study_file(setup, arguments.study, study), [] {});
  return done;
}

int run_accuracy(AccuracyArguments& arguments, Team& team) {
  StudyOptions& options = arguments.study;
  read_list(arguments, "--tolerances", options.tolerances);
  read_list(arguments, "--orders", options.orders);
  read_list(arguments, "--grids", options.grids);
  if (const auto faults = find_faults(options); !faults.empty())
    throw InputError("--" + joined(faults, "; --"));
  TraceSetup setup = given_setup(arguments);
  project_if_large(setup.model, setup.options);
  SharedJob job{shared_run(setup, arguments), hdf5_format(accuracy_format, "work-precision study"), 1};
  job.writes = arguments.output.given->count() > 0;
  Study study;
  job.compute = [&](const std::vector<std::size_t>&, Workers& workers, ProgressBar& progress) {
    study = accuracy_study(setup, options, workers, [&](int done, int all) {
      progress.update(static_cast<double>(done) / all, done, "runs");
    });
    return std::vector<std::string>();
  };
  job.finish = [&](const ComputedRun&) { return finish_study(setup, arguments, job, study); };
  return carry_out(job, arguments.output, team);
}

}  // namespace

void add_accuracy(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<AccuracyArguments>(
      program, exit_code, in_team(run_accuracy, alone), "accuracy",
      "work-precision study of a scene: the error really achieved, and what it costs");
  StudyOptions& options = arguments->study;
  add_scene(*command, *arguments);
  add_output(*command, arguments->output, "file to write (HDF5); default: none");
  for (const auto& [flag, help] :
       {std::array{"--tolerances", "tolerances to trace with: A,B,... (1e-2,1e-3,...,1e-12)"},
        std::array{"--orders", "orders of the power series: A,B,... (1,2,3,4)"},
        std::array{"--grids",
                   "points of the grids of the other methods: A,B,..., or none (25,50,...,800)"}}) {
    add_text(*command, flag, arguments->lists, flag, help);
  }
  command->add_option("--samples", options.samples, "parameter values at which errors are measured")
      ->capture_default_str();
  command->add_option("--repeat", options.repeat, "runs whose median time counts")->capture_default_str();
  add_override(*command, *arguments, "parameter", "name of the traced parameter");
  add_override(*command, *arguments, "from", "where the range begins");
  add_override(*command, *arguments, "to", "where it ends");
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n  eigentrail accuracy data/scenes/rotating_mass.toml --tolerances 1e-4,1e-8 -o study.h5");
}

}  // namespace eigentrail::app
