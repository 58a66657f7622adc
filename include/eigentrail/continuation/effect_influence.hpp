// Influence of each effect of a scene on each mode: derivatives of the eigenvalues with respect to the
// strength of the effect.
#pragma once

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Derivatives of the eigenvalues with respect to the strength of one effect: ds/de at e = 1, where e
/// multiplies the forces of the effect and the equilibrium changes with e.
struct EffectInfluence {
  std::string effect;
  ComplexVector derivatives;  ///< one per mode, 1/s; NaN at a multiple eigenvalue, which has no derivative
};

struct Influences {
  std::string fault;  ///< why they could not be computed; empty on success
  ComplexVector s;    ///< eigenvalues of least |s| at the start of the trace, 1/s
  std::vector<EffectInfluence> effects;
};

/// Influences of all effects at the start of the trace of `setup`, on the number of modes that its option
/// `modes` gives (absent: all). The setup must come from prepare_trace with `strengths` = true. Failures are
/// reported in `fault`.
Influences effect_influences(const TraceSetup& setup);

}  // namespace eigentrail
