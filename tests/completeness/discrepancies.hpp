// The events of a trace against those of the reference.
#pragma once

#include <string>
#include <vector>

#include "completeness/random_family.hpp"
#include "completeness/reference_events.hpp"
#include "eigentrail/continuation/event.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

constexpr double same_place = 1e-6;  ///< of the range

struct Discrepancy {
  std::string what;  ///< "missing flutter", "invented collision", "direction of divergence", ...
  double p = 0.0;
  std::string text;  ///< one line with place and eigenvalue
};

/// What was traced: the range, and how far the trace came.
struct Traced {
  double from = 0.0, to = 0.0, reached = 0.0;
};

/// Events that only one side has. They are the same within `same_place`. Events this close to an end of
/// the trace or to a place where the reference is undecided may be there or not. Veerings and extrema are not
/// compared. Crossings, and collisions off the real axis, do not happen in random families.
std::vector<Discrepancy> find_discrepancies(const ReferenceEvents& reference,
                                            const std::vector<Event>& events, const Traced& traced);

/// Traces all modes with the default tolerance.
RecordedTrace trace_family(const RandomFamily& family);

/// Traces in both directions and compares. Returns what is wrong, a line each.
std::vector<std::string> check_completeness(const RandomFamily& family);

}  // namespace eigentrail::test
