// What a trace calls on its way, and what it can be left with.
#pragma once

#include <functional>
#include <string>

#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// What a trace can go on from: all points up to here have been handed to the observer.
class Checkpoint {
 public:
  virtual const TraceResult& so_far() const = 0;
  /// The state of the trace as bytes, for resume_trace. They belong to this version of the program.
  virtual std::string save() const = 0;

 protected:
  ~Checkpoint() = default;
};

/// Called during a trace, in this order: `started` once, then `point` for every point; `checkpoint` between
/// points. The latter two return whether to go on.
struct TraceObserver {
  std::function<void(const TraceStart&)> started = [](const TraceStart&) {};
  std::function<bool(const TracePoint&)> point = [](const TracePoint&) { return true; };
  std::function<bool(const Checkpoint&)> checkpoint = [](const Checkpoint&) { return true; };
};

}  // namespace eigentrail
