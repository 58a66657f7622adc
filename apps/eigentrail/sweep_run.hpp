// One run of a sweep: a trace of the scene with other values of some parameters.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail::app {

/// A parameter that a sweep varies, and its values in the parameter's unit.
struct Varied {
  std::string name;
  std::vector<double> values;
};

/// All combinations of the values, the last parameter changing fastest.
class Combinations {
 public:
  explicit Combinations(std::vector<Varied> varied) : varied_(std::move(varied)) {}

  std::size_t size() const;
  /// The values of a combination, counted from 0, in the order of the parameters.
  std::vector<double> values(std::size_t number) const;
  const std::vector<Varied>& varied() const { return varied_; }

  /// NAME=VALUE of each parameter.
  std::vector<std::string> settings(std::size_t number) const;

 private:
  std::vector<Varied> varied_;
};

/// The least damping ratio -Re s / |s| of the complex pairs of a path, and where it is, at the points of the
/// trace and at places between them.
struct LeastDamping {
  double ratio = 0.0, p = 0.0;
};
std::optional<LeastDamping> least_damping(const RecordedPath& path);

/// What a run has come to: a line of the index of the sweep.
struct SweepRow {
  std::size_t run = 0;         ///< from 1
  std::string file;            ///< the loci file's name; empty if none was written
  std::vector<double> values;  ///< of the varied parameters
  int exit_code = 0;           ///< that of `eigentrail trace`
  int points = 0;
  double reached = 0.0;                       ///< last value of the traced parameter; NaN without points
  std::optional<double> flutter, divergence;  ///< where the first one of the trace is
  std::optional<LeastDamping> damping;
  std::string reason;  ///< why the run failed; empty if it did not
};

/// First line and lines of the index, with their line ends.
std::string index_header(const std::vector<Varied>& varied);
std::string index_line(const SweepRow& row);

/// Throws InputError if `path` is not the loci file of this run.
void require_run_of_sweep(const Scene& scene, const std::vector<std::string>& settings,
                          const OptionTexts& options, const std::string& path);

/// Traces `scene` with `settings` (NAME=VALUE) and writes the loci file `path`. An error ends up in the row.
/// May be called by several threads at once.
SweepRow run_of_sweep(const Scene& scene, const std::vector<std::string>& settings,
                      const OptionTexts& options, const std::string& path, const SaveOptions& saving);

}  // namespace eigentrail::app
