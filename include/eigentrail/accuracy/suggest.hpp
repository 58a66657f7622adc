// Which values of the parameter to sample next.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// A value of the parameter where another sample helps most.
struct Suggestion {
  double p = 0.0;      ///< in the parameter's unit, between two samples
  double error = 0.0;  ///< stated error of the eigenvalue there, relative to max(|s|, reference)
  Complex s;           ///< the eigenvalue with that error, of the followed modes
  std::string note;    ///< that no mode is as wanted; empty else
};

/// One suggestion for each gap between samples within the range of the trace, the largest error first.
/// `reference` as in TraceOptions, or 1e-3 of the median |s|. Throws InputError if the model is not sampled
/// or has a single sample. Cost: a dense spectrum per gap.
std::vector<Suggestion> suggest_samples(const TraceSetup& setup);

}  // namespace eigentrail
