#include "sweep_run.hpp"

#include <cmath>
#include <filesystem>
#include <mutex>

#include "commands.hpp"
#include "eigentrail/accuracy/findings.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/scene/settings.hpp"
#include "eigentrail/store/saved_trace.hpp"

namespace eigentrail::app {
namespace {

/// Places of a step at which damping ratios are looked at, beside its ends.
constexpr int places_per_step = 16;

/// The HDF5 library must not be used by two threads at once. All threads of a sweep take turns.
std::mutex& turn_at_files() {
  static std::mutex mutex;
  return mutex;
}

std::string csv_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? exact_text(*value) : "";
}

std::optional<double> first_of(EventKind kind, const std::vector<Event>& events, double from) {
  std::optional<double> first;
  for (const Event& event : events) {
    if (event.kind == kind && (!first || std::abs(event.p - from) < std::abs(*first - from))) first = event.p;
  }
  return first;
}

TraceSetup setup_of(const Scene& scene, const std::vector<std::string>& settings,
                    const OptionTexts& options) {
  const std::scoped_lock turn(turn_at_files());
  return prepare_trace(with_settings(scene, settings).scene, options);
}

/// A trace whose points go to a loci file.
class RunOfSweep {
 public:
  RunOfSweep(TraceSetup setup, const std::string& path, const SaveOptions& saving)
      : setup_(std::move(setup)), path_(path), saving_(saving) {}
  ~RunOfSweep() {
    const std::scoped_lock turn(turn_at_files());
    writer_.reset();
  }
  RunOfSweep(const RunOfSweep&) = delete;
  RunOfSweep& operator=(const RunOfSweep&) = delete;

  void into(SweepRow& row) {
    TraceResult result = trace(*setup_.model, setup_.options, observer());
    if (!has_started(result.status)) throw InputError(setup_.scene.path + ": " + result.message);
    const Findings found = find_ranges_and_errors(*setup_.model, setup_.options, recorder_.path(), result);
    {
      const std::scoped_lock turn(turn_at_files());
      writer_->finish(result, found.ranges, found.errors ? &*found.errors : nullptr);
    }
    row.file = std::filesystem::path(path_).filename().string();
    row.points = result.nodes;
    row.reached = result.reached;
    row.flutter = first_of(EventKind::flutter, result.events, setup_.options.from);
    row.divergence = first_of(EventKind::divergence, result.events, setup_.options.from);
    row.damping = least_damping(found.path);
    row.exit_code = result.status == TraceStatus::completed ? done : numbers_failed;
    row.reason = result.message;
  }

 private:
  TraceObserver observer() {
    TraceObserver observer;
    observer.started = [this](const TraceStart& start) { started_ = start; };
    observer.point = [this](const TracePoint& point) {
      const std::scoped_lock turn(turn_at_files());
      if (!writer_)
        writer_.emplace(path_, setup_.scene, *setup_.model, setup_.options, started_, point, saving_);
      writer_->append(point);
      recorder_.append(point);
      return true;
    };
    observer.checkpoint = [this](const Checkpoint& checkpoint) {
      const std::scoped_lock turn(turn_at_files());
      writer_->checkpoint(checkpoint);
      return true;
    };
    return observer;
  }

  TraceSetup setup_;
  const std::string& path_;
  const SaveOptions& saving_;
  TraceStart started_;
  std::optional<LociWriter> writer_;
  PathRecorder recorder_;
};

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
  std::string line = "run,file";
  for (const Varied& one : varied) line += "," + csv_cell(one.name);
  return line + ",exit,points,reached,flutter,divergence,least_damping,least_damping_at,reason\n";
}

std::string index_line(const SweepRow& row) {
  std::string line = std::to_string(row.run) + "," + csv_cell(row.file);
  for (const double value : row.values) line += "," + exact_text(value);
  const auto part_of_damping = [&row](double LeastDamping::*part) {
    return csv_number(row.damping ? std::optional((*row.damping).*part) : std::nullopt);
  };
  return line + "," + std::to_string(row.exit_code) + "," + std::to_string(row.points) + "," +
         csv_number(row.reached) + "," + csv_number(row.flutter) + "," + csv_number(row.divergence) + "," +
         part_of_damping(&LeastDamping::ratio) + "," + part_of_damping(&LeastDamping::p) + "," +
         csv_cell(printable(row.reason)) + "\n";
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
    RunOfSweep run(std::move(setup), path, saving);
    run.into(row);
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
