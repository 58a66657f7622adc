// Writes the loci file (HDF5, schema 1) as the trace goes.
//
// The file grows in memory and is saved from time to time: what stands under its name is complete at every
// moment, whatever happens to the process, the disk or the power. Behind its HDF5 data it has the state that
// `trace --resume` goes on from.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/stability/stable_ranges.hpp"
#include "eigentrail/store/saved_trace.hpp"

namespace eigentrail {

inline constexpr int loci_schema_version = 1;
inline constexpr const char* loci_format = "eigentrail-loci";

/// Refuses names of the traced parameter that the loci file uses for something else. Throws InputError.
void check_parameter_name(const Scene& scene, const std::string& parameter);

/// The file could not be written on; what was saved before stays.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class LociWriter {
 public:
  /// Seconds of work that may be lost at most.
  static constexpr double usual_interval = 2.0;

  /// Begins a file, which appears under its name with the first checkpoint; an existing one is replaced in
  /// that moment. The point `first` tells what directions of motion mean; it is appended by `append`. It is
  /// saved every `save_every` seconds, or more rarely where saving would take more than a twentieth of the
  /// time. Throws InputError when the file cannot be created or another process writes it.
  LociWriter(const std::string& path, const Scene& scene, const Model& model, const TraceOptions& options,
             const TraceStart& start, const TracePoint& first, double save_every = usual_interval);

  /// Goes on with the file that `saved` was read from. Throws InputError when it does not fit, likewise.
  LociWriter(const std::string& path, const Model& model, const TraceOptions& options,
             const SavedTrace& saved, double save_every = usual_interval);

  ~LociWriter();
  LociWriter(const LociWriter&) = delete;
  LociWriter& operator=(const LociWriter&) = delete;

  // All of the following throw WriteError when they cannot write; the writer is then of no more use.

  /// Adds a point and the step that led to it.
  void append(const TracePoint& point);

  /// Saves what there is, when it is time; at the first call in any case. Returns whether it has.
  bool checkpoint(const Checkpoint& checkpoint);

  /// Saves what there is, as a trace that was interrupted.
  void interrupt(const Checkpoint& checkpoint);

  /// A name for each mode that says what moves in it; empty where nothing is known.
  std::vector<std::string> mode_names() const;

  /// Writes what is left, the events, the stable ranges, and the outcome and counts of the run.
  void finish(const TraceResult& result, const std::vector<StableRange>& ranges);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace eigentrail
