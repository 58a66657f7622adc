#include "eigentrail/continuation/trace.hpp"

#include <stdexcept>

#include "continuation/trace/trace_loop.hpp"

namespace eigentrail {

bool has_started(TraceStatus status) {
  return status == TraceStatus::completed || status == TraceStatus::no_branch ||
         status == TraceStatus::step_too_small || status == TraceStatus::too_many_nodes ||
         status == TraceStatus::stopped || status == TraceStatus::outside_band;
}

namespace {

void check(const Model& model, const TraceOptions& options) {
  const std::vector<OptionFault> faults = find_faults(options, model.description().parameters);
  if (!faults.empty())
    throw std::invalid_argument("trace: " + faults.front().key + ": " + faults.front().message);
}

}  // namespace

TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis) {
  check(model, options);
  return TraceLoop(model, options, observer, basis).run();
}

TraceResult resume_trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                         std::string_view state) {
  check(model, options);
  return TraceLoop(model, options, observer, BasisChoice::aligned).resume(state);
}

}  // namespace eigentrail
