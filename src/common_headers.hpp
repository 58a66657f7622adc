// Precompiled header of all code but the kernels (core/precompiled.hpp): the headers that most of it
// includes. No file may depend on it: builds without it (preset dev) give the same program and only take
// longer.
#pragma once

#include "core/precompiled.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/model/build.hpp"
