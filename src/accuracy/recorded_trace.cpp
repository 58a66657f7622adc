#include "eigentrail/accuracy/recorded_trace.hpp"

namespace eigentrail {

TraceObserver RecordedTrace::observer() {
  TraceObserver observer;
  observer.started = [this](const TraceStart& start) { started_ = start; };
  observer.point = [this](const TracePoint& point) {
    if (!writer_)
      writer_.emplace(path_, setup_.scene, *setup_.model, setup_.options, started_, point, saving_);
    writer_->append(point);
    recorder_.append(point);
    return true;
  };
  observer.checkpoint = [this](const Checkpoint& checkpoint) {
    const bool goes_on = watch_.goes_on(checkpoint, recorder_.points());
    if (!goes_on) writer_->interrupt(checkpoint);
    if (!goes_on || writer_->checkpoint(checkpoint)) watch_.saved(recorder_.points());
    return goes_on;
  };
  return observer;
}

const TraceResult& RecordedTrace::begin() {
  return result_ = trace(*setup_.model, setup_.options, observer());
}

const TraceResult& RecordedTrace::resume(const SavedTrace& saved) {
  recorder_ = PathRecorder(saved.path);
  writer_.emplace(path_, *setup_.model, setup_.options, saved, saving_);
  watch_.saved(recorder_.points());
  return result_ = resume_trace(*setup_.model, setup_.options, observer(), saved.trace);
}

Findings RecordedTrace::find() {
  return find_ranges_and_errors(*setup_.model, setup_.options, recorder_.path(), result_);
}

void RecordedTrace::finish(const Findings& found) {
  writer_->finish(result_, found.ranges, found.errors ? &*found.errors : nullptr);
}

TracedFile trace_in_memory(const TraceSetup& setup,
                           const std::function<bool(const Checkpoint& checkpoint, int points)>& goes_on) {
  RecordedTrace recorded(setup, {.goes_on = goes_on});
  const TraceResult& result = recorded.begin();
  if (!has_started(result.status)) return {"", result};
  if (result.status != TraceStatus::stopped) {
    const Findings found = recorded.find();
    if (result.status == TraceStatus::outside_band) return {"", result};
    recorded.finish(found);
  }
  return {recorded.writer()->bytes(), result};
}

}  // namespace eigentrail
