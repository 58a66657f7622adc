// Derivatives of eigenvalues with respect to parameters, at one value of the traced parameter; the
// equilibrium follows the parameters. Influence of each effect of a scene: derivatives with respect to its
// strength.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct Sensitivities {
  std::string fault = {};            ///< why they could not be computed; empty on success
  ComplexVector s = {};              ///< the chosen eigenvalues of least |s|, 1/s
  std::vector<int> parameters = {};  ///< indices
  /// Mode x parameter: ds/dq, in 1/s per declared unit; NaN at a multiple eigenvalue, which has no
  /// derivative.
  ComplexMatrix derivatives = {};
};

/// Indices of the parameters that are not defined by others.
std::vector<int> free_parameters(const Parameters& parameters);

/// Derivatives with respect to `parameters` at the value `p` of the traced parameter, in its unit, of the
/// modes that the option `modes` chooses. `guess`: an equilibrium near the one that is meant; empty: the
/// model's own guess. Cost: an equilibrium, a QZ, a singular value decomposition per mode, and the
/// first-order terms along each parameter.
Sensitivities sensitivities_at(const TraceSetup& setup, double p, const std::vector<int>& parameters,
                               const Vector& guess = {});

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
