// Criteria: real functions of an eigenvalue whose zeros or extrema are events.
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/event_options.hpp"
#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// The functions, with mu = s, or mu = 1/s in the reciprocal chart, and s the member of a complex pair with
/// Im s > 0:
///
///   flutter        Re mu                    also of real eigenvalues, where a zero is divergence
///   damping_ratio  Re mu + value |mu|       this and the following: of complex pairs only
///   log_decrement  Re mu + zeta |mu|        with zeta = value / sqrt(4 pi^2 + value^2)
///   resonance      Im s - value excitation  times |mu|^2 in the reciprocal chart
///   band_edge      Im s - value             likewise
///   extremum       Re mu / |mu|             its extrema are the events, not its zeros
struct Criterion {
  EventKind kind = EventKind::flutter;
  double value = 0.0;  ///< damping ratio, logarithmic decrement, multiple of the excitation, or rad/s

  bool asks_for_extrema() const { return kind == EventKind::extremum; }
  bool asks_for_pairs() const { return kind != EventKind::flutter; }
};

/// The criteria that a trace evaluates: flutter always, and those that the scene requests.
std::vector<Criterion> criteria_of(const EventOptions& options);

/// The criterion that is zero at an event; none for events that are not zeros of a function of one
/// eigenvalue.
std::optional<Criterion> criterion_of(const Event& event);

/// Taylor coefficients of the criterion, as many as `mu` has, from those of mu and of the excitation
/// frequency (rad/s; used for resonances only). Not finite where mu vanishes and the function has no power
/// series.
Vector criterion_series(const Criterion& criterion, const ComplexVector& mu, Chart chart,
                        const Vector& excitation);

/// Value of the criterion.
double criterion_value(const Criterion& criterion, Complex mu, Chart chart, double excitation);
/// The same of s where the parameters have these values, in declared units.
double criterion_value(const Criterion& criterion, Complex s, const EventOptions& options,
                       const Parameters& parameters, const Vector& values);

/// Series of the excitation frequency (rad/s, order + 1 coefficients) from the series of the parameters
/// (declared units, one row per parameter, one column per power). Zero if the scene has no excitation.
Vector excitation_series(const EventOptions& options, const Parameters& parameters,
                         const VectorSeries& series, int order);

}  // namespace eigentrail
