// The rows of a loci file: points and the steps between them, appended as they come.
#pragma once

#include <map>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Rows that wait to be written, row-major.
struct LociRows {
  std::vector<double> parameter, frequency, damping_ratio, residual, condition, equilibrium, multiplier;
  std::vector<Complex> eigenvalue, eigenvalue_derivative, mode_shape;
  std::vector<double> step_length, step_parameter;
  std::vector<Complex> dense_output;
  std::vector<std::int64_t> dense_block, dense_chart, mode_block, certified;

  std::size_t points() const { return parameter.size(); }
  std::size_t steps() const { return step_length.size(); }
};

class LociTables {
 public:
  /// Creates all datasets in `file`, which has none, for `modes` modes, series of the given order, and the
  /// motions of the model's masses.
  LociTables(Hdf5File file, const Model& model, const TraceOptions& options, int order, std::size_t modes,
             const std::vector<std::string>& motions);

  /// Goes on with a file that has them, as far as it is written.
  LociTables(Hdf5File file, const Model& model, const TraceOptions& options);

  std::size_t modes() const { return modes_; }
  std::size_t functions() const { return functions_; }  ///< rows of dense output per step

  /// Makes room for more; what is in the file stays, with NaN in the new places. All rows must be written.
  void grow_modes(std::size_t wanted);
  void grow_functions(std::size_t wanted);

  void append(const LociRows& rows);

  Hdf5File& file() { return file_; }

 private:
  void create_dimensions(const ModelDescription& description, int order, std::size_t modes);
  void extend(const std::string& dimension, std::size_t size);

  Hdf5File file_;
  std::string parameter_;
  bool has_constraints_ = false;
  std::size_t modes_ = 0, functions_ = 0;
  std::uint64_t points_ = 0, steps_ = 0;  ///< written so far
  /// Growing datasets by the dimension along which they may have to be extended.
  std::map<std::string, std::vector<std::pair<std::string, unsigned>>> extensible_;
};

}  // namespace eigentrail
