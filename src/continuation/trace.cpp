#include "eigentrail/continuation/trace.hpp"

#include <stdexcept>

#include "continuation/tracer.hpp"

namespace eigentrail {

bool has_started(TraceStatus status) {
  return status == TraceStatus::completed || status == TraceStatus::no_branch ||
         status == TraceStatus::step_too_small || status == TraceStatus::too_many_nodes ||
         status == TraceStatus::stopped;
}

TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis) {
  const std::vector<OptionFault> faults = find_faults(options, model.description().parameters);
  if (!faults.empty())
    throw std::invalid_argument("trace: " + faults.front().key + ": " + faults.front().message);
  return Tracer(model, options, observer, basis).run();
}

}  // namespace eigentrail
