#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

#include "core/texts.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
#include "eigentrail/model/function_family.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/map_writer.hpp"
#include "engine.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace eigentrail::python {
namespace {

/// A function p -> matrices that Python gives instead of the tables of the scene.
struct FunctionSource {
  py::function call;              ///< p -> dict of M, C, K or E, A
  FunctionFamilyOptions options;  ///< without the parameter and its range
};

/// What a user should know of a scene before its results.
std::vector<std::string> remarks_on(const Scene& scene, const Model& model) {
  std::vector<std::string> remarks;
  for (const int parameter : model.description().unused_parameters)
    remarks.emplace_back(unused_error(scene, parameter).what());
  return remarks;
}

MatricesAt matrices_of(std::map<std::string, Matrix> given) {
  return {std::move(given["M"]), std::move(given["C"]), std::move(given["K"]), std::move(given["E"]),
          std::move(given["A"])};
}

TraceSetup prepare(const Scene& scene, const Options& options, const std::optional<FunctionSource>& source,
                   Watch& watch) {
  if (!source) return prepare_trace(scene, options);
  return prepare_trace(
      scene, options, [&](const Parameters& parameters, const TraceOptions& trace) -> std::unique_ptr<Model> {
        const auto call = [&, calls = 0](double p) mutable {
          watch.require(0.0, calls++);
          const py::gil_scoped_acquire acquired;
          return matrices_of(source->call(p).cast<std::map<std::string, Matrix>>());
        };
        FunctionFamilyOptions family = source->options;
        family.parameter = trace.parameter;
        family.unit = parameters.at(trace.parameter).unit;
        std::tie(family.from, family.to) = std::minmax(trace.from, trace.to);
        return std::make_unique<FunctionFamily>(call, family);
      });
}

/// The file that `work` computes without the interpreter lock. Where it was stopped and leaves nothing,
/// throws what stopped it: an exception of `progress`, or KeyboardInterrupt.
template <class Work>
Outcome computed(const py::object& progress, Work&& work) {
  Watch watch(progress);
  Outcome outcome;
  std::string file;
  try {
    file = unlocked([&]() -> std::string { return work(watch, outcome); });
  } catch (const Stopped&) {
    watch.rethrow();
  }
  outcome.interrupted = watch.interrupted();
  if (!outcome.interrupted) watch.rethrow();
  outcome.file = py::bytes(file);
  return outcome;
}

Outcome run_trace(const Scene& scene, const Options& options, const std::optional<FunctionSource>& source,
                  int threads, const py::object& progress) {
  return computed(progress, [&](Watch& watch, Outcome& outcome) {
    TraceSetup setup = prepare(scene, options, source, watch);
    outcome.remarks = remarks_on(setup.scene, *setup.model);
    check_parameter_name(setup.scene, setup.options.parameter);
    project_if_large(setup.model, setup.options);
    setup.options.threads = static_cast<int>(Threads(threads).size());
    TracedFile traced = trace_in_memory(setup, [&](const Checkpoint& checkpoint, int points) {
      const auto& [from, to] = std::pair(setup.options.from, setup.options.to);
      return watch((checkpoint.so_far().reached - from) / (to - from), points);
    });
    const TraceStatus status = traced.result.status;
    if (status != TraceStatus::completed && status != TraceStatus::stopped)
      outcome.message = traced.result.message;
    return std::move(traced.bytes);
  });
}

Outcome run_boundary(const Scene& scene, const Options& options, const std::string& second, double from,
                     double to, std::optional<double> damping_ratio, std::optional<int> lines,
                     const py::object& progress) {
  return computed(progress, [&](Watch& watch, Outcome& outcome) {
    const BoundarySetup setup = prepare_boundary(scene, {second, from, to, options, damping_ratio, lines});
    outcome.remarks = remarks_on(setup.scene, *setup.model);
    check_boundary_names(setup);
    const BoundaryResult result = find_boundaries(
        *setup.model, setup.options, [&](double share, int points) { watch.require(share, points); });
    if (result.status != BoundaryStatus::completed) outcome.message = result.message;
    return result.status == BoundaryStatus::no_equilibrium ? "" : boundary_file(setup, result);
  });
}

Outcome run_map(const Scene& scene, const Options& options, const std::string& second, double from, double to,
                int n_second, int n_first, int jobs, const py::object& progress) {
  return computed(progress, [&](Watch& watch, Outcome& outcome) {
    const MapSetup setup = prepare_map(scene, options, {second, from, to, n_second, n_first, jobs});
    outcome.remarks = remarks_on(setup.trace.scene, *setup.trace.model);
    check_map_names(setup);
    const StabilityMap map =
        stability_map(setup, [&](int lines) { watch.require(static_cast<double>(lines) / n_second, lines); });
    return map_file(setup, map);
  });
}

Outcome run_accuracy(const Scene& scene, const Options& options, const std::vector<double>& tolerances,
                     const std::vector<int>& orders, const std::vector<int>& grids, int samples, int repeat,
                     const py::object& progress) {
  const StudyOptions study_options{tolerances, orders, grids, samples, repeat};
  const std::vector<std::string> faults = find_faults(study_options);
  if (!faults.empty()) throw InputError(joined(faults, "; "));
  return computed(progress, [&](Watch& watch, Outcome& outcome) -> std::string {
    TraceSetup setup = prepare_trace(scene, options);
    outcome.remarks = remarks_on(setup.scene, *setup.model);
    project_if_large(setup.model, setup.options);
    Threads one(1);
    const Study study = accuracy_study(setup, study_options, one, [&](int done, int all) {
      watch.require(static_cast<double>(done) / all, done);
    });
    if (!study.reference.samples.empty()) return study_file(setup, study_options, study);
    outcome.message = setup.scene.path + ": no reference could be computed anywhere on the range";
    return "";
  });
}

}  // namespace

void add_runs(py::module_& module) {
  py::class_<Outcome>(module, "Outcome")
      .def_readonly("file", &Outcome::file)
      .def_readonly("message", &Outcome::message)
      .def_readonly("interrupted", &Outcome::interrupted)
      .def_readonly("remarks", &Outcome::remarks);
  py::class_<FunctionSource>(module, "FunctionSource")
      .def(py::init([](py::function call, double tolerance, int max_calls, double resolution,
                       std::vector<double> breaks, std::vector<std::string> names) {
        return FunctionSource{std::move(call),
                              {.tolerance = tolerance,
                               .max_calls = max_calls,
                               .resolution = resolution,
                               .breaks = std::move(breaks),
                               .state_names = std::move(names)}};
      }));
  module.def("trace", &run_trace);
  module.def("boundary", &run_boundary);
  module.def("stability_map", &run_map);
  module.def("accuracy", &run_accuracy);
}

}  // namespace eigentrail::python
