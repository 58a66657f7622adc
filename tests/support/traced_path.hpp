// The options of a trace over a range; a trace with the path as it is recorded.
#pragma once

#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace.hpp"

namespace eigentrail::test {

struct TracedPath {
  TraceResult result;
  RecordedPath path;
};

inline TraceOptions options_on(double from, double to) {
  TraceOptions options;
  options.parameter = "p";
  options.from = from;
  options.to = to;
  return options;
}

/// `most_points`: where the trace stops; 0: it does not.
inline TracedPath trace_path(const Model& model, const TraceOptions& options, int most_points = 0) {
  TracedPath traced;
  PathRecorder recorder;
  TraceObserver observer;
  observer.point = [&](const TracePoint& point) {
    recorder.append(point);
    return recorder.points() != most_points;
  };
  traced.result = trace(model, options, observer);
  traced.path = recorder.path();
  return traced;
}

}  // namespace eigentrail::test
