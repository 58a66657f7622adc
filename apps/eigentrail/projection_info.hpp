// What the summary of a trace says of a projected model.
#pragma once

#include <string>

#include "eigentrail/model/projection.hpp"

namespace eigentrail::app {

void print_projection(const Projection& projection, const std::string& parameter);

}  // namespace eigentrail::app
