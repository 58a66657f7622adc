// The functions of the compiled module `eigentrail._engine`. Files go to Python as bytes: they are those that
// the program writes.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail::python {

/// Options as for the command line: keys and texts.
using Options = std::vector<std::pair<std::string, std::string>>;

/// A matrix as the package hands it over: doubles in C order. Others are converted in Python, where it is
/// checked that no number changes.
using Doubles = pybind11::array_t<double, pybind11::array::c_style>;

/// What a computation leaves.
struct Outcome {
  pybind11::bytes file;              ///< HDF5; empty: nothing was computed
  std::string message;               ///< why it did not come to its end; empty if it did
  bool interrupted = false;          ///< by Ctrl-C
  std::vector<std::string> remarks;  ///< warnings for the user
};

/// Text in UTF-8; bytes that are none, as damaged files have them, become replacement characters.
pybind11::object as_text(const std::string& text);

void add_scenes(pybind11::module_& module);
void add_runs(pybind11::module_& module);
void add_points(pybind11::module_& module);
void add_files(pybind11::module_& module);
void add_paths(pybind11::module_& module);

}  // namespace eigentrail::python
