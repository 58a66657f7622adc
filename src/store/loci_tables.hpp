// Appends points and steps to the datasets of a loci file.
#pragma once

#include <map>

#include "core/hdf5_writer.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Points and steps that are not written yet; every member is a flat row-major array of one dataset.
struct LociRows {
  std::vector<double> parameter, frequency, damped_frequency, damping_ratio, residual, condition, rounding,
      equilibrium, multiplier;
  std::vector<double> whirl, whirl_reverse;  ///< only of models in which something spins
  std::vector<Complex> eigenvalue, eigenvalue_derivative, mode_shape;
  std::vector<double> step_length, step_parameter;
  std::vector<std::vector<double>> trimmed, step_trimmed;  ///< per trimmed parameter
  std::vector<Complex> dense_output;
  std::vector<std::int64_t> dense_block, dense_chart, mode_block, certified, growing_unfollowed;

  std::size_t points() const { return parameter.size(); }
  std::size_t steps() const { return step_length.size(); }
};

class LociTables {
 public:
  /// Creates all datasets in `file`, which must be empty: for `modes` modes and power series of this order.
  /// `motions`: labels of the motions of the model's masses.
  LociTables(Hdf5Writer file, const Model& model, const TraceOptions& options, int order, std::size_t modes,
             const std::vector<std::string>& motions);

  /// Continues a file that has the datasets, behind the rows that are written.
  LociTables(Hdf5Writer file, const Model& model, const TraceOptions& options);

  std::size_t modes() const { return modes_; }
  std::size_t functions() const { return functions_; }  ///< rows of dense output per step

  /// Extends the datasets to more modes or functions. The new elements of existing rows read as NaN, or -1
  /// for integers. Rows that are not written yet have the old width: they must be appended first.
  void grow_modes(std::size_t wanted);
  void grow_functions(std::size_t wanted);

  void append(const LociRows& rows);

  Hdf5Writer& file() { return file_; }

 private:
  void create_dimensions(const ModelDescription& description, int order, std::size_t modes);
  void extend(const std::string& dimension, std::size_t size);

  Hdf5Writer file_;
  std::string parameter_;
  std::vector<std::string> trimmed_;  ///< names of trimmed parameters
  bool has_constraints_ = false;
  std::size_t modes_ = 0, functions_ = 0;
  std::uint64_t points_ = 0, steps_ = 0;  ///< numbers written so far
  /// Per dimension: the growing datasets that have it, and its position among their dimensions.
  std::map<std::string, std::vector<std::pair<std::string, unsigned>>> extensible_;
};

}  // namespace eigentrail
