// The dense output of results whose datasets are arrays of Python.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

#include "eigentrail/stability/boundary.hpp"
#include "engine.hpp"
#include "store/path_datasets.hpp"

namespace py = pybind11;

namespace eigentrail::python {
namespace {

template <class Element>
using Array = py::array_t<Element, py::array::c_style | py::array::forcecast>;
using Steps = Array<std::int64_t>;
using Places = Array<double>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Datasets of a loci file by their names.
class Datasets {
 public:
  explicit Datasets(py::dict arrays) : arrays_(std::move(arrays)) {}

  Shape shape(const std::string& name) const {
    const py::array array(arrays_[name.c_str()]);
    return {array.shape(), array.shape() + array.ndim()};
  }
  std::vector<double> read_real(const std::string& name) const { return read<double>(name); }
  std::vector<Complex> read_complex(const std::string& name) const { return read<Complex>(name); }
  std::vector<std::int64_t> read_integers(const std::string& name) const { return read<std::int64_t>(name); }

 private:
  template <class Element>
  std::vector<Element> read(const std::string& name) const {
    const Array<Element> array(arrays_[name.c_str()]);
    return {array.data(), array.data() + array.size()};
  }

  py::dict arrays_;
};

RecordedPath path_in(const py::dict& arrays, const std::string& parameter) {
  const Datasets datasets(arrays);
  const Shape shape = datasets.shape("eigenvalue");
  return read_path(datasets, parameter, shape.empty() ? 0 : shape.back(), "the Dataset");
}

/// Whether the parameter may have a value several times.
bool turns_back(const RecordedPath& path) {
  return !std::all_of(path.steps.begin(), path.steps.end(), follows_parameter) ||
         (!std::is_sorted(path.p.begin(), path.p.end()) && !std::is_sorted(path.p.rbegin(), path.p.rend()));
}

/// The places with these values of the parameter, in their order along the path: steps and t in [0, 1], value
/// x passage. A value with fewer places than another has step -1 and t NaN in the others.
std::pair<Steps, Places> places(const RecordedPath& path, const Places& values) {
  std::vector<std::vector<PathPosition>> found;
  std::size_t passages = 1;
  {
    const py::gil_scoped_release released;
    for (py::ssize_t i = 0; i < values.size(); ++i) {
      found.push_back(path.positions(values.data()[i]));
      passages = std::max(passages, found.back().size());
    }
  }
  const std::vector<std::size_t> shape{found.size(), passages};
  Steps steps(shape);
  Places t(shape);
  std::int64_t* step_there = steps.mutable_data();
  double* t_there = t.mutable_data();
  for (const std::vector<PathPosition>& of_value : found) {
    for (std::size_t k = 0; k < passages; ++k) {
      *step_there++ = k < of_value.size() ? static_cast<std::int64_t>(of_value[k].step) : -1;
      *t_there++ = k < of_value.size() ? of_value[k].t : nan;
    }
  }
  return {steps, t};
}

/// At t on steps (arrays of one shape): eigenvalues, with the modes as last dimension, and values of the
/// parameter. NaN where a mode does not exist, and on step -1.
std::pair<py::array_t<Complex>, Places> evaluate(const RecordedPath& path, const Steps& steps,
                                                 const Places& t) {
  std::vector<py::ssize_t> shape(steps.shape(), steps.shape() + steps.ndim());
  Places parameter(shape);
  shape.push_back(path.eigenvalues.cols());
  py::array_t<Complex> eigenvalues(shape);
  if (t.size() != steps.size()) throw InputError("expected as many places as steps");
  Complex* s = eigenvalues.mutable_data();
  double* p = parameter.mutable_data();
  {
    const py::gil_scoped_release released;
    for (py::ssize_t i = 0; i < t.size(); ++i, s += path.eigenvalues.cols()) {
      const PathPosition place{static_cast<std::size_t>(steps.data()[i]), t.data()[i]};
      const bool exists = place.step < path.steps.size();
      p[i] = exists ? path.parameter_at(place) : nan;
      Eigen::Map<ComplexVector> row(s, path.eigenvalues.cols());
      row.setConstant(Complex(nan, nan));
      if (exists) row = path.eigenvalues_at(place);
    }
  }
  return {eigenvalues, parameter};
}

/// Both parameters, tau and delta (place x 4) of a boundary at t on steps of these lengths (place) and series
/// (place x 4 x 2 x order).
Places boundary_places(const Places& length, const Places& series, const Places& t) {
  if (series.ndim() != 4 || series.shape(1) != 4 || series.shape(2) != 2 || series.shape(0) != t.size() ||
      length.size() != t.size())
    throw InputError("the Dataset: dense_output does not fit the other datasets");
  const py::ssize_t orders = series.shape(3);
  Places result(std::vector<py::ssize_t>{t.size(), 4});
  for (py::ssize_t i = 0; i < t.size(); ++i) {
    const BoundaryStep step = boundary_step(length.data()[i], series.data() + i * 8 * orders, orders);
    Eigen::Map<Eigen::Vector4d>(result.mutable_data() + 4 * i) = evaluate_step(step, t.data()[i]);
  }
  return result;
}

}  // namespace

void add_paths(py::module_& module) {
  py::class_<RecordedPath>(module, "Path")
      .def(py::init(&path_in))
      .def_property_readonly("turns_back", &turns_back)
      .def("places", &places)
      .def("evaluate", &evaluate);
  module.def("boundary_places", &boundary_places);
}

}  // namespace eigentrail::python
