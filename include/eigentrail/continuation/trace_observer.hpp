// The callbacks of a trace, and the checkpoints from which it can be resumed.
#pragma once

#include <functional>
#include <string>

#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// The state of a trace between two points. All points so far have been handed to the observer.
class Checkpoint {
 public:
  virtual const TraceResult& so_far() const = 0;
  /// The state of the trace as bytes, for resume_trace. Only the same version of the program can read them.
  virtual std::string save() const = 0;

 protected:
  ~Checkpoint() = default;
};

/// Functions that a trace calls: `started` once, then `point` for every point, and `checkpoint` between two
/// points. The last two return whether the trace shall go on.
struct TraceObserver {
  std::function<void(const TraceStart&)> started = [](const TraceStart&) {};
  std::function<bool(const TracePoint&)> point = [](const TracePoint&) { return true; };
  std::function<bool(const Checkpoint&)> checkpoint = [](const Checkpoint&) { return true; };
};

}  // namespace eigentrail
