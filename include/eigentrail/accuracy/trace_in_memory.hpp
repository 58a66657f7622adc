// A trace whose loci file stays in memory.
#pragma once

#include <functional>
#include <string>

#include "eigentrail/continuation/trace.hpp"

namespace eigentrail {

struct [[nodiscard]] TracedFile {
  std::string bytes;  ///< of the loci file; empty if the trace has no first point
  TraceResult result;
};

/// Traces a prepared scene whose large model is projected already. `goes_on`: called between two points with
/// the number of points so far; if it returns false, the trace ends there and the file is an interrupted one.
TracedFile trace_in_memory(const TraceSetup& setup,
                           const std::function<bool(const Checkpoint& checkpoint, int points)>& goes_on);

}  // namespace eigentrail
