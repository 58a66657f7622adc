// A trace whose points go to a loci file, on the disk or in memory.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "eigentrail/accuracy/findings.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail {

class RecordedTrace {
 public:
  /// What happens between two points.
  struct Watch {
    /// Whether the trace goes on, after this number of points; if not, it ends there and the file is an
    /// interrupted one.
    std::function<bool(const Checkpoint& checkpoint, int points)> goes_on = [](const Checkpoint&, int) {
      return true;
    };
    /// Called when the file has been saved with this number of points.
    std::function<void(int points)> saved = [](int) {};
  };

  /// A trace of a prepared scene whose large model is projected already; the setup must outlive it. `path`:
  /// of the loci file; empty: it stays in memory.
  RecordedTrace(const TraceSetup& setup, Watch watch, std::string path = {}, const SaveOptions& saving = {})
      : setup_(setup), watch_(std::move(watch)), path_(std::move(path)), saving_(saving) {}

  // These throw WriteError if the file cannot be written.

  /// Traces from the start; without a first point there is no file.
  const TraceResult& begin();
  /// Goes on from what is saved.
  const TraceResult& resume(const SavedTrace& saved);
  /// What was found along a trace that has ended; it may change the result, as find_ranges_and_errors says.
  Findings find();
  /// Completes the file of a trace that has ended.
  void finish(const Findings& found);

  const TraceResult& result() const { return result_; }
  RecordedPath path() const { return recorder_.path(); }
  /// Empty before the first point.
  const std::optional<LociWriter>& writer() const { return writer_; }

 private:
  TraceObserver observer();

  const TraceSetup& setup_;
  Watch watch_;
  std::string path_;
  SaveOptions saving_;
  TraceStart started_;
  std::optional<LociWriter> writer_;
  PathRecorder recorder_;
  TraceResult result_;
};

struct [[nodiscard]] TracedFile {
  std::string bytes;  ///< of the loci file; empty if the trace has no first point
  TraceResult result;
};

/// The whole trace in memory. `goes_on` as above.
TracedFile trace_in_memory(const TraceSetup& setup,
                           const std::function<bool(const Checkpoint& checkpoint, int points)>& goes_on);

}  // namespace eigentrail
