// The independent parts of a family on the range of a trace, conjugate pairs of complex parts included
// (complex_blocks.hpp).
//
// A complex part has eigenvalues on both sides of the real axis. Those below are the conjugates of modes of
// its conjugate part. While none of them is near the axis, the modes with Im s >= 0 of both are all modes of
// the pair. A mode that passes through the axis would go over to the conjugate part. Such a pair is followed
// as one real part.
#pragma once

#include <memory>

#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// The parts of a family. A conjugate pair is two complex parts if none of its eigenvalues is near the real
/// axis, or passes through it or through infinity, at some places of the range; else one real part. Null
/// where the equations neither fall apart nor need balancing. Cost: that of find_independent_parts, and for
/// complex parts a few spectra without vectors.
std::shared_ptr<const IndependentParts> parts_of_family(const PathProblem& problem,
                                                        const TraceOptions& options);

/// Whether an eigenvalue is near the real axis: |Im s| is below a small share of |s|, or not above
/// `smallest`, the magnitude that counts as zero. Both in 1/s.
bool is_near_real_axis(Complex s, double smallest);

}  // namespace eigentrail
