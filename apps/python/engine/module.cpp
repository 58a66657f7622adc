// The engine for Python. The package around it, in apps/python/eigentrail, is what users see.
#include <pybind11/pybind11.h>

#include <regex>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/model/function_family.hpp"
#include "eigentrail/projection/project.hpp"
#include "engine.hpp"

namespace py = pybind11;

namespace {

/// Options of the program are keywords here: --damping-ratio is damping_ratio, and a range has both its ends.
std::string in_words_of_python(std::string message) {
  static const std::regex ends("as --(from|to)"), second("--second-(?=from|to)"),
      hyphen("(--[a-z_]+)-(?=[a-z])"), dashes("--(?=[a-z])");
  message = std::regex_replace(message, ends, "as a range such as speed=(0, 400)");
  message = std::regex_replace(message, second, "");
  while (std::regex_search(message, hyphen)) message = std::regex_replace(message, hyphen, "$1_");
  return std::regex_replace(message, dashes, "");
}

/// Errors of a type of C++ become errors of a class of the package.
template <class CppError>
void raise_as(const char* name) {
  static PyObject* const raised =
      py::object(py::module_::import("eigentrail.errors").attr(name)).release().ptr();
  py::register_local_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const CppError& found) {
      PyErr_SetObject(raised, eigentrail::python::as_text(in_words_of_python(found.what())).ptr());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_engine, module) {
  module.doc() = "The compiled part of eigentrail.";
  raise_as<eigentrail::InputError>("SceneError");
  raise_as<eigentrail::NotResolved>("NotResolved");
  raise_as<eigentrail::NotProjected>("NotProjected");
  eigentrail::python::add_scenes(module);
  eigentrail::python::add_runs(module);
  eigentrail::python::add_points(module);
  eigentrail::python::add_files(module);
  eigentrail::python::add_paths(module);
}
