// What each effect of a scene does to each mode.
#pragma once

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Derivatives of eigenvalues with respect to the strength of one effect: ds/de where its forces are
/// multiplied by e = 1, the equilibrium following.
struct EffectInfluence {
  std::string effect;
  ComplexVector derivatives;  ///< one per mode, 1/s; NaN at a multiple eigenvalue, which has none
};

struct Influences {
  std::string fault;  ///< why there are none; empty: there are
  ComplexVector s;    ///< the modes of least |s| where the trace begins
  std::vector<EffectInfluence> effects;
};

/// Influences on `modes` modes at most (absent: all) where the trace of `setup` begins. The setup must have
/// been prepared with strengths.
Influences effect_influences(const TraceSetup& setup);

}  // namespace eigentrail
