// The datasets of a loci file that hold its path: points, and steps with their dense output. They may lie in
// a file or in memory.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/hdf5_types.hpp"
#include "eigentrail/continuation/recorded_path.hpp"

namespace eigentrail {

/// As flat row-major arrays.
struct PathArrays {
  Shape shape;  ///< of `output`: step, function, end, order
  std::vector<double> p, length, parameter;
  std::vector<Complex> eigenvalue, output;
  std::vector<std::int64_t> block, chart, mode_block, certified;
};

/// Throws InputError, which says that the dataset does not fit the others, unless it does. `name`: of the
/// file.
void require_fit(bool fits, const std::string& name, const std::string& dataset);

/// Throws InputError for a number that is infinite or NaN.
void require_finite(const std::vector<double>& values, const std::string& name, const std::string& dataset);

/// The path of `n_modes` modes. Throws InputError if blocks, modes and functions do not fit each other.
RecordedPath path_of(PathArrays arrays, std::size_t n_modes, const std::string& name);

/// Reads the path. `datasets` has the functions shape, read_real, read_complex and read_integers of Hdf5File;
/// `parameter` is the name of the traced parameter. Throws InputError, with the `name` of the file, if the
/// datasets contradict each other.
template <class Datasets>
RecordedPath read_path(const Datasets& datasets, const std::string& parameter, std::size_t n_modes,
                       const std::string& name) {
  PathArrays arrays;
  const auto require_shape = [&](const std::string& dataset, const Shape& expected) {
    require_fit(datasets.shape(dataset) == expected, name, dataset);
  };
  arrays.p = datasets.read_real(parameter);
  require_shape(parameter, {arrays.p.size()});
  require_shape("eigenvalue", {arrays.p.size(), n_modes});
  arrays.eigenvalue = datasets.read_complex("eigenvalue");
  arrays.shape = datasets.shape("dense_output");
  const Shape& shape = arrays.shape;
  require_fit(shape.size() == 4 && shape[0] + 1 == std::max<std::uint64_t>(arrays.p.size(), 1) &&
                  shape[2] == 2 && shape[3] >= 2 && shape[3] <= static_cast<std::uint64_t>(max_order),
              name, "dense_output");
  require_shape("step_length", {shape[0]});
  require_shape("step_parameter", {shape[0], 2, shape[3]});
  for (const char* dataset : {"dense_block", "dense_chart"}) require_shape(dataset, {shape[0], shape[1]});
  for (const char* dataset : {"mode_block", "certified"}) require_shape(dataset, {shape[0], n_modes});
  arrays.length = datasets.read_real("step_length");
  arrays.parameter = datasets.read_real("step_parameter");
  arrays.output = datasets.read_complex("dense_output");
  arrays.block = datasets.read_integers("dense_block");
  arrays.chart = datasets.read_integers("dense_chart");
  arrays.mode_block = datasets.read_integers("mode_block");
  arrays.certified = datasets.read_integers("certified");
  require_finite(arrays.p, name, parameter);
  require_finite(arrays.length, name, "step_length");
  require_finite(arrays.parameter, name, "step_parameter");
  return path_of(std::move(arrays), n_modes, name);
}

}  // namespace eigentrail
