// Computes the errors of eigenvalues that come from the data of the model.
#pragma once

#include <optional>

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/operating_point.hpp"
#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Empty if the data of the model have no errors that are known. Where eigenvalues meet inside a step, the
/// error grows with the inverse of their distance. Cost: a dense spectrum with left and right vectors at up
/// to three places between two samples. `events`: all events of the trace.
std::optional<DataErrors> data_errors(const Model& model, const TraceOptions& options,
                                      const RecordedPath& path, const std::vector<Event>& events);

/// Bounds at one value of the parameter, without a trace: a row per eigenvalue of `s`, with the columns
/// interpolation and digits. Empty likewise.
std::optional<Matrix> data_errors_at(const Model& model, const TraceOptions& options, double p,
                                     const ComplexVector& s);
/// The same for the modes at an operating point.
std::optional<Matrix> data_errors_at(const Model& model, const TraceOptions& options,
                                     const OperatingPoint& point);

}  // namespace eigentrail
