// The trace: a predictor-corrector loop along the path, from the scene's starting equilibrium to the end of
// the range.
#pragma once

#include <string_view>

#include "eigentrail/continuation/trace_observer.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Whether the trace produced points before it ended.
bool has_started(TraceStatus status);

/// Follows the modes of `model` as `options` say. Numerical failures end in the result's status; the points
/// before them have been handed to the observer. Throws std::invalid_argument for options with faults
/// (find_faults).
TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis = BasisChoice::aligned);

/// Goes on from a checkpoint of a trace of the same model with the same options: the points that follow, and
/// the result, are bit for bit those of the trace that was left; `started` is not called. Throws InputError
/// when the state is damaged or belongs to another model.
TraceResult resume_trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                         std::string_view state);

}  // namespace eigentrail
