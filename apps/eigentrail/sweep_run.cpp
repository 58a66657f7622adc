#include "sweep_run.hpp"

#include <cmath>
#include <filesystem>

#include "commands.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/scene/settings.hpp"
#include "eigentrail/store/saved_trace.hpp"
#include "records.hpp"

namespace eigentrail::app {
namespace {

/// Places of a step at which damping ratios are looked at, beside its ends.
constexpr int places_per_step = 16;

std::optional<double> first_of(EventKind kind, const std::vector<Event>& events, double from) {
  std::optional<double> first;
  for (const Event& event : events) {
    if (event.kind == kind && (!first || std::abs(event.p - from) < std::abs(*first - from))) first = event.p;
  }
  return first;
}

TraceSetup setup_of(const Scene& scene, const std::vector<std::string>& settings,
                    const OptionTexts& options) {
  const Hdf5Turn turn;
  return prepare_trace(with_settings(scene, settings).scene, options);
}

void trace_into(SweepRow& row, const TraceSetup& setup, const std::string& path, const SaveOptions& saving) {
  RecordedTrace recorded(setup, {}, path, saving);
  const TraceResult& result = recorded.begin();
  if (!has_started(result.status)) throw InputError(setup.scene.path + ": " + result.message);
  const Findings found = recorded.find();
  recorded.finish(found);
  row.file = std::filesystem::path(path).filename().string();
  row.points = result.nodes;
  row.reached = result.reached;
  row.flutter = first_of(EventKind::flutter, result.events, setup.options.from);
  row.divergence = first_of(EventKind::divergence, result.events, setup.options.from);
  row.damping = least_damping(found.path);
  row.exit_code = result.status == TraceStatus::completed ? done : numbers_failed;
  row.reason = result.message;
}

}  // namespace

std::size_t Combinations::size() const {
  std::size_t product = 1;
  for (const Varied& one : varied_) product *= one.values.size();
  return product;
}

std::vector<double> Combinations::values(std::size_t number) const {
  std::vector<double> values(varied_.size());
  for (std::size_t i = varied_.size(); i-- > 0;) {
    const std::size_t count = varied_[i].values.size();
    values[i] = varied_[i].values[number % count];
    number /= count;
  }
  return values;
}

std::vector<std::string> Combinations::settings(std::size_t number) const {
  const std::vector<double> of_run = values(number);
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < of_run.size(); ++k)
    settings.push_back(varied_[k].name + "=" + exact_text(of_run[k]));
  return settings;
}

std::optional<LeastDamping> least_damping(const RecordedPath& path) {
  std::optional<LeastDamping> least;
  for (std::size_t step = 0; step < path.steps.size(); ++step) {
    for (int k = 0; k <= places_per_step; ++k) {
      const PathPosition at{step, static_cast<double>(k) / places_per_step};
      for (const Complex s : path.eigenvalues_at(at)) {
        if (!std::isfinite(std::abs(s)) || s.imag() == 0.0) continue;
        const double ratio = -s.real() / std::abs(s);
        if (!least || ratio < least->ratio) least = {ratio, path.parameter_at(at)};
      }
    }
  }
  return least;
}

std::string index_header(const std::vector<Varied>& varied) {
  std::vector<Cell> cells{"run", "file"};
  for (const Varied& one : varied) cells.emplace_back(one.name);
  for (const char* column :
       {"exit", "points", "reached", "flutter", "divergence", "least_damping", "least_damping_at", "reason"})
    cells.emplace_back(column);
  return csv_line(cells, "");
}

std::string index_line(const SweepRow& row) {
  std::vector<Cell> cells{count(row.run), row.file};
  cells.insert(cells.end(), row.values.begin(), row.values.end());
  const LeastDamping damping = row.damping.value_or(LeastDamping{NAN, NAN});
  cells.insert(cells.end(), {count(row.exit_code), count(row.points), row.reached, row.flutter.value_or(NAN),
                             row.divergence.value_or(NAN), damping.ratio, damping.p, printable(row.reason)});
  return csv_line(cells, "");
}

void require_run_of_sweep(const Scene& scene, const std::vector<std::string>& settings,
                          const OptionTexts& options, const std::string& path) {
  const TraceSetup setup = setup_of(scene, settings, options);
  (void)read_saved_trace(path, setup.scene, setup.options);
}

SweepRow run_of_sweep(const Scene& scene, const std::vector<std::string>& settings,
                      const OptionTexts& options, const std::string& path, const SaveOptions& saving) {
  SweepRow row;
  row.reached = std::nan("");
  try {
    TraceSetup setup = setup_of(scene, settings, options);
    project_if_large(setup.model, setup.options);
    check_parameter_name(setup.scene, setup.options.parameter);
    trace_into(row, setup, path, saving);
  } catch (const InputError& error) {
    row.exit_code = bad_input;
    row.reason = error.what();
  } catch (const std::exception& error) {
    row.exit_code = numbers_failed;
    row.reason = error.what();
  }
  return row;
}

}  // namespace eigentrail::app
