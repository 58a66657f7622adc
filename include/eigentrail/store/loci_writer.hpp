// Writes the loci file (HDF5, schema 1) as the trace goes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/events/stable_ranges.hpp"

namespace eigentrail {

inline constexpr int loci_schema_version = 1;
inline constexpr const char* loci_format = "eigentrail-loci";

/// Refuses names of the traced parameter that the loci file uses for something else. Throws InputError.
void check_parameter_name(const Scene& scene, const std::string& parameter);

class LociWriter {
 public:
  /// Creates `path` with its header. The file appears under its name complete with header or not at all; an
  /// existing file is replaced in that moment. Throws std::runtime_error when the file cannot be written.
  LociWriter(const std::string& path, const Scene& scene, const Model& model, const TraceOptions& options,
             const TraceStart& start);
  ~LociWriter();
  LociWriter(const LociWriter&) = delete;
  LociWriter& operator=(const LociWriter&) = delete;

  /// Adds a point and the step that led to it; they reach the disk with the next flush, after at most a
  /// second of further points.
  void append(const TracePoint& point);

  /// A name for each mode that says what moves in it; empty where nothing is known.
  std::vector<std::string> mode_names() const;

  /// Writes what is buffered, the events, the stable ranges, and the outcome and counts of the run.
  void finish(const TraceResult& result, const std::vector<StableRange>& ranges);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace eigentrail
