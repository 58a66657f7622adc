// What the program says of large models and their projections.
#pragma once

#include <cstdio>
#include <string>

#include "eigentrail/model/projection.hpp"
#include "eigentrail/projection/route.hpp"

namespace eigentrail::app {

/// What the summary of a trace says.
void print_projection(const Projection& projection, const std::string& parameter);

/// Why a model takes its route.
std::string reason_of(const Route& route);

/// What `explain` says before anything is factored.
void print_route(const Route& route, const ProjectionEstimate& estimate, const TraceOptions& options,
                 std::FILE* to);

}  // namespace eigentrail::app
