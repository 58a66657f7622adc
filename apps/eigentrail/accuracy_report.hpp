// Prints a work-precision study as text.
#pragma once

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail::app {

/// Prints the number and the error of the references, tables of all runs, and conclusions.
void print_study(const TraceSetup& setup, const Study& study);

}  // namespace eigentrail::app
