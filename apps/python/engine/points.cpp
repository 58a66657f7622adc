#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/continuation/linear_model.hpp"
#include "eigentrail/continuation/operating_point.hpp"
#include "eigentrail/continuation/operating_range.hpp"
#include "eigentrail/continuation/sensitivities.hpp"
#include "eigentrail/explain.hpp"
#include "eigentrail/projection/project.hpp"
#include "engine.hpp"
#include "watch.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace eigentrail::python {
namespace {

/// The model of single values, if there are none of that where the trace begins; a large one is projected so
/// that it is exact at each of them.
TraceSetup prepare_at(const Scene& scene, const Options& options, std::vector<double>& values) {
  TraceSetup setup = prepare_trace(scene, options, Purpose::operating_point);
  if (values.empty()) values.push_back(setup.options.from);
  project_at_if_large(setup.model, setup.options, values);
  return setup;
}

/// One row per value and mode; without values, where the trace begins.
py::dict spectrum(const Scene& scene, const Options& options, std::vector<double> values) {
  std::vector<OperatingPoint> points;
  std::vector<std::optional<Matrix>> errors;
  unlocked([&] {
    const TraceSetup setup = prepare_at(scene, options, values);
    points = operating_points(setup, values);
    for (const OperatingPoint& point : points)
      errors.push_back(data_errors_at(*setup.model, setup.options, point));
  });
  py::list rows, faults;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].fault.empty()) faults.append(py::make_tuple(points[k].p, points[k].fault));
    for (std::size_t i = 0; i < points[k].modes.size(); ++i) {
      const OperatingMode& mode = points[k].modes[i];
      const Complex s = shown(mode);
      py::dict row("parameter"_a = points[k].p, "mode"_a = i + 1, "eigenvalue"_a = mode.s,
                   "natural_frequency"_a = std::abs(s), "damped_frequency"_a = std::abs(s.imag()),
                   "damping_ratio"_a = -s.real() / std::abs(s), "what_moves"_a = mode.what_moves,
                   "condition"_a = mode.condition, "rounding"_a = mode.rounding);
      if (errors[k]) {
        row["interpolation_error"] = (*errors[k])(static_cast<Eigen::Index>(i), 0);
        row["digits_error"] = (*errors[k])(static_cast<Eigen::Index>(i), 1);
      }
      rows.append(row);
    }
  }
  return py::dict("rows"_a = rows, "faults"_a = faults);
}

/// An array of all samples, or of texts.
py::object as_array(const NamedSamples& array) {
  if (!array.texts.empty()) return py::cast(array.texts);
  const Matrix& first = array.samples.front();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(array.samples.size()), first.rows(), first.cols()};
  shape.resize(1 + static_cast<std::size_t>(array.rank));
  Doubles result(shape);
  double* entry = result.mutable_data();
  for (const Matrix& sample : array.samples) {
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(entry, first.rows(),
                                                                                       first.cols()) = sample;
    entry += first.size();
  }
  return result;
}

/// Per name an array, and whether its first axis counts values.
py::dict linearize(const Scene& scene, const Options& options, std::vector<double> values,
                   const std::vector<std::string>& inputs) {
  LinearModels models;
  std::vector<NamedSamples> found;
  unlocked([&] {
    const TraceSetup setup = prepare_trace(scene, options, Purpose::operating_point);
    if (values.empty()) values.push_back(setup.options.from);
    models = linear_models(setup, values, inputs);
    if (!models.found.empty()) found = arrays_of(setup, models.found, inputs);
  });
  py::dict arrays;
  for (const NamedSamples& array : found)
    arrays[py::str(array.name)] = py::make_tuple(as_array(array), array.texts.empty());
  return py::dict("arrays"_a = arrays, "faults"_a = models.faults, "notes"_a = models.notes);
}

/// Derivatives of the eigenvalues with respect to all parameters that are not derived, at one value of the
/// traced parameter.
py::dict sensitivities(const Scene& scene, const Options& options, double value, const Vector& guess) {
  Sensitivities found;
  std::vector<std::string> names;
  unlocked([&] {
    std::vector<double> values{value};
    const TraceSetup setup = prepare_at(scene, options, values);
    const Parameters& parameters = setup.model->description().parameters;
    found = sensitivities_at(setup, value, free_parameters(parameters), guess);
    for (const int parameter : found.parameters)
      names.push_back(parameters[static_cast<std::size_t>(parameter)].name);
  });
  if (!found.fault.empty()) throw InputError(scene.path + ": " + found.fault);
  return py::dict("eigenvalue"_a = found.s, "parameter"_a = names, "derivative"_a = found.derivatives);
}

/// What `eigentrail explain` prints.
std::string explanation(const Scene& scene, const Options& options, bool sensitivity) {
  char* text = nullptr;
  std::size_t size = 0;
  const auto free_text = [](char** allocated) { std::free(*allocated); };
  const std::unique_ptr<char*, decltype(free_text)> owner(&text, free_text);
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> to(open_memstream(&text, &size), &std::fclose);
  if (to == nullptr) throw std::bad_alloc();
  unlocked([&] { app::explain(to.get(), prepare_trace(scene, options), options, sensitivity); });
  to.reset();  // what was written is in `text` once the stream is closed
  return {text, size};
}

/// Whether a critical speed keeps less than its margin from one of the ranges, or lies within it.
bool is_too_close(const std::vector<std::pair<double, double>>& ranges, const std::optional<double>& margin,
                  double speed, Complex s) {
  OperatingRanges operating{{}, margin};
  for (const auto& [from, to] : ranges) operating.ranges.push_back({from, to});
  const std::optional<Separation> found = separation(operating, speed, s);
  return found && found->is_too_close();
}

}  // namespace

void add_points(py::module_& module) {
  module.def("spectrum", &spectrum);
  module.def("linearize", &linearize);
  module.def("explain", &explanation);
  module.def("sensitivities", &sensitivities);
  module.def("is_too_close", &is_too_close);
  module.def("api_margin", [](Complex s, bool below) { return api_margin(amplification_factor(s), below); });
}

}  // namespace eigentrail::python
