#include "core/precompiled.hpp"

#define EIGENTRAIL_COMPILED_ONCE template
#include "core/decompositions_lu.inc"
