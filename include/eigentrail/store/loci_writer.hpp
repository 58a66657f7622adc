// Writes the loci file (HDF5, schema 1) during a trace.
//
// The file grows in memory. From time to time it is written to the disk and replaces the last version
// atomically, so the file on the disk is always complete, also after a crash or a power failure. After the
// HDF5 data the file contains the state of the trace, from which `trace --resume` continues.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/stability/stable_ranges.hpp"
#include "eigentrail/store/output_file.hpp"
#include "eigentrail/store/saved_trace.hpp"

namespace eigentrail {

inline constexpr int loci_schema_version = 1;
inline constexpr const char* loci_format = "eigentrail-loci";

/// Throws InputError if the traced parameter has the name of a dataset of the loci file.
void check_parameter_name(const Scene& scene, const std::string& parameter);

/// The file could not be written. The last saved version remains.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How a loci file is saved.
struct SaveOptions {
  double interval = 2.0;  ///< seconds between saves, which is the work that may be lost
  Existing existing = Existing::keep;
  bool lock = true;  ///< against other processes; not all file systems can
};

class LociWriter {
 public:
  /// Begins a file. The first point of the trace, `first`, defines the directions of motion for the names of
  /// modes; it must be appended with `append` as well. Checkpoints save the file every `interval` seconds, or
  /// less often if saving would take more than a twentieth of the time. Throws InputError if the file cannot
  /// be created or another process writes it. Without a `path` the file stays in memory: checkpoints save
  /// nothing, and `bytes` gives it.
  LociWriter(const std::string& path, const Scene& scene, const Model& model, const TraceOptions& options,
             const TraceStart& start, const TracePoint& first, const SaveOptions& saving = {});

  /// Continues the file that `saved` was read from, and replaces it. Throws InputError if it does not fit the
  /// model or another process writes it.
  LociWriter(const std::string& path, const Model& model, const TraceOptions& options,
             const SavedTrace& saved, const SaveOptions& saving = {});

  ~LociWriter();
  LociWriter(const LociWriter&) = delete;
  LociWriter& operator=(const LociWriter&) = delete;

  // `checkpoint`, `interrupt` and `finish` throw WriteError if they cannot write the file. The writer must
  // not be used after that.

  /// Adds a point and the step that led to it.
  void append(const TracePoint& point);

  /// Saves the file and the state of the trace if the interval has passed. Returns whether it has saved.
  bool checkpoint(const Checkpoint& checkpoint);

  /// Saves the file and the state of the trace, with status "interrupted".
  void interrupt(const Checkpoint& checkpoint);

  /// The bytes of the file as `interrupt` or `finish` saved it, of a file that stays in memory.
  const std::string& bytes() const;

  /// A description of each mode by the masses that move in it; empty where unknown.
  std::vector<std::string> mode_names() const;

  /// Writes the remaining points, the events, the stable ranges, the errors of the model's data (null if
  /// there are none), and the outcome and counts of the run, and
  /// saves the file without a state of the trace.
  void finish(const TraceResult& result, const std::vector<StableRange>& ranges,
              const DataErrors* errors = nullptr);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace eigentrail
