// Real functions of an eigenvalue whose zeros, or extrema, are events of a trace.
#pragma once

#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/event_options.hpp"
#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// With mu = s, or 1/s in the reciprocal chart, and Im s > 0 of a pair:
///
///   flutter        Re mu                    real roots too: their divergence
///   damping_ratio  Re mu + value |mu|       pairs only, as the following
///   log_decrement  Re mu + zeta |mu|        with zeta = value / sqrt(4 pi^2 + value^2)
///   resonance      Im s - value excitation  times |mu|^2 in the reciprocal chart
///   extremum       Re mu / |mu|             its extrema
struct Criterion {
  EventKind kind = EventKind::flutter;
  double value = 0.0;  ///< the damping ratio, the decrement, or the harmonic

  bool asks_for_extrema() const { return kind == EventKind::extremum; }
  bool asks_for_pairs() const { return kind != EventKind::flutter; }
};

std::vector<Criterion> criteria_of(const EventOptions& options);

/// Coefficients of the function from those of mu and of the excitation frequency (rad/s; not used but for
/// resonances), of one length. Not finite where mu vanishes and the function has no series there.
Vector criterion_series(const Criterion& criterion, const ComplexVector& mu, Chart chart,
                        const Vector& excitation);

double criterion_value(const Criterion& criterion, Complex mu, Chart chart, double excitation);

/// The excitation frequency along a series of the parameters (declared units, one column per power); zero
/// without one.
Vector excitation_series(const EventOptions& options, const Parameters& parameters,
                         const VectorSeries& series, int order);

}  // namespace eigentrail
