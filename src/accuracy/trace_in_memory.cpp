#include "eigentrail/accuracy/trace_in_memory.hpp"

#include <optional>

#include "eigentrail/accuracy/findings.hpp"
#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail {

TracedFile trace_in_memory(const TraceSetup& setup,
                           const std::function<bool(const Checkpoint& checkpoint, int points)>& goes_on) {
  TraceStart started;
  std::optional<LociWriter> writer;
  PathRecorder recorder;
  TraceObserver observer;
  observer.started = [&](const TraceStart& start) { started = start; };
  observer.point = [&](const TracePoint& point) {
    if (!writer) writer.emplace(setup.scene, *setup.model, setup.options, started, point);
    writer->append(point);
    recorder.append(point);
    return true;
  };
  observer.checkpoint = [&](const Checkpoint& checkpoint) {
    if (goes_on(checkpoint, recorder.points())) return true;
    writer->interrupt(checkpoint);
    return false;
  };
  TracedFile traced;
  traced.result = trace(*setup.model, setup.options, observer);
  if (!has_started(traced.result.status)) return traced;
  if (traced.result.status != TraceStatus::stopped) {
    const Findings found =
        find_ranges_and_errors(*setup.model, setup.options, recorder.path(), traced.result);
    if (traced.result.status == TraceStatus::outside_band) return traced;
    writer->finish(traced.result, found.ranges, found.errors ? &*found.errors : nullptr);
  }
  traced.bytes = writer->bytes();
  return traced;
}

}  // namespace eigentrail
