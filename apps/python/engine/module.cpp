// The engine for Python. The package around it, in apps/python/eigentrail, is what users see.
#include <pybind11/pybind11.h>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/version.hpp"
#include "eigentrail/model/function_family.hpp"
#include "eigentrail/projection/project.hpp"
#include "engine.hpp"

namespace py = pybind11;

PYBIND11_MODULE(_engine, module) {
  module.doc() = "The compiled part of eigentrail.";
  module.attr("version") = eigentrail::version();
  py::register_exception<eigentrail::InputError>(module, "SceneError", PyExc_ValueError);
  py::register_exception<eigentrail::NotResolved>(module, "NotResolved", PyExc_RuntimeError);
  py::register_exception<eigentrail::NotProjected>(module, "NotProjected", PyExc_RuntimeError);
  eigentrail::python::add_scenes(module);
  eigentrail::python::add_runs(module);
  eigentrail::python::add_points(module);
  eigentrail::python::add_files(module);
}
