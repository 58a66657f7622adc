// A work-precision study for people.
#pragma once

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail::app {

/// Prints what errors were measured against, a table of all runs, and what follows from them.
void print_study(const TraceSetup& setup, const Study& study);

}  // namespace eigentrail::app
