// Traces for benchmarks: timed without an observer's work, or recorded for their dense output.
#pragma once

#include <string>

#include "eigentrail/continuation/recorded_path.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

struct TimedTrace {
  TraceResult result;
  double seconds = 0.0;         ///< CPU time, the first spectrum included
  double follow_seconds = 0.0;  ///< the same from the first point on

  double seconds_per_mode_step() const;
};

/// Throws std::runtime_error unless the trace is completed.
TimedTrace time_trace(const Setting& setting, const TraceOptions& options);

/// The dense output of a trace, and the reference of its relative errors.
struct Recording {
  RecordedPath path;
  double s_ref = 0.0;
};
Recording record(const Setting& setting, const TraceOptions& options);

/// A reference recording: order 4, with a tolerance of 1e-3 times that of the trace that is compared with it.
Recording reference_of(const Setting& setting, const TraceOptions& judged);

/// Eigenvalues of all modes (columns) at parameters in the direction of the trace (rows), on a path that does
/// not turn back.
ComplexMatrix sample(const RecordedPath& path, const std::vector<double>& p);

/// Largest error relative to max(|s|, s_ref).
double largest_error(const ComplexMatrix& values, const ComplexMatrix& exact, double s_ref);

/// `count` parameters, equally spaced from one end of the trace to the other, shifted by `shift` of a spacing
/// inwards (0: the ends are among them).
std::vector<double> parameters_on(const TraceOptions& options, int count, double shift = 0.0);

}  // namespace eigentrail::test
