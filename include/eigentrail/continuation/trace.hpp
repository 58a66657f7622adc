// The trace: a predictor-corrector continuation of the equilibrium and the eigenvalues, from one end of the
// range of the parameter to the other.
#pragma once

#include <string_view>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// Whether a trace that ended with this status has produced points.
bool has_started(TraceStatus status);

/// Follows the modes of `model` as `options` say. Numerical failures end the trace and are reported in the
/// result's status; the points before them have been handed to the observer. `basis` is how the tangent basis
/// is chosen at each point. Throws std::invalid_argument for invalid options (find_faults).
TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis = BasisChoice::aligned);

/// Continues a trace of the same model with the same options from the state that Checkpoint::save returned.
/// The following points and the result are bit for bit those of an uninterrupted trace. The observer's
/// `started` is not called. Throws InputError if the state is damaged or belongs to another model, and
/// std::invalid_argument for invalid options.
TraceResult resume_trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                         std::string_view state);

}  // namespace eigentrail
