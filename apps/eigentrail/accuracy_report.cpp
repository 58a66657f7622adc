#include "accuracy_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <set>

#include "eigentrail/core/text.hpp"
#include "output.hpp"

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

/// Prints for each tolerance the fastest trace that had this tolerance or a smaller one and achieved it, and
/// the fastest run on a grid that achieved it.
void print_advice(const std::vector<MeasuredRun>& runs) {
  std::set<double, std::greater<>> bounds;
  for (const MeasuredRun& run : runs) {
    if (run.method == Method::trace) bounds.insert(run.tolerance);
  }
  const auto is_rival = [](const MeasuredRun& run) { return !by_trace(run); };
  const bool rivals = std::any_of(runs.begin(), runs.end(), is_rival);
  std::vector<std::vector<std::string>> rows{{"error below", "fastest trace"}};
  if (rivals) rows[0].emplace_back("fastest instead");
  for (const double bound : bounds) {
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
  std::set<double> tolerances;
  for (const MeasuredRun& run : runs) {
    if (run.method == Method::trace) tolerances.insert(run.tolerance);
  }
  for (const double tolerance : tolerances) {
    const MeasuredRun* best = fastest(runs, INFINITY, [&](const MeasuredRun& run) {
      return run.method == Method::trace && run.tolerance == tolerance;
    });
    if (best != nullptr) ++wins[static_cast<std::size_t>(best->order)];
  }
  return static_cast<int>(std::max_element(wins.begin(), wins.end()) - wins.begin());
}

/// Prints the cost of the certificate: the run with the scene's own options compared with the next one in the
/// list, which has the same options without certificate.
void print_cost_of_certificate(const std::vector<MeasuredRun>& runs) {
  const auto without = std::find_if(runs.begin(), runs.end(), [](const MeasuredRun& run) {
    return run.method == Method::trace_uncertified;
  });
  if (without == runs.end() || without == runs.begin()) return;
  const MeasuredRun& with = *std::prev(without);
  const double share = (with.seconds - without->seconds) / with.seconds;
  std::printf(
      "; the certificate costs %s of the time at tolerance %s and order %d (%llu LU with it, %llu without)",
      share > 0.0 ? (rounded(100.0 * share, 2) + " %").c_str() : "less than the noise",
      exact_text(with.tolerance).c_str(), with.order, static_cast<unsigned long long>(with.factorizations),
      static_cast<unsigned long long>(without->factorizations));
}

void print_conclusions(const std::vector<MeasuredRun>& runs) {
  const auto traces = std::count_if(runs.begin(), runs.end(), by_trace);
  const auto kept = std::count_if(runs.begin(), runs.end(), [](const MeasuredRun& run) {
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

}  // namespace

void print_study(const TraceSetup& setup, const Study& study) {
  print_title(setup.scene.title);
  print_reference(study.reference, setup.options.parameter);
  print_traces(study.runs);
  print_rivals(study.runs);
  print_advice(study.runs);
  print_conclusions(study.runs);
}

}  // namespace eigentrail::app
