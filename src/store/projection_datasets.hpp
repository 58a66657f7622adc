// The datasets of a loci file that tell what the projected coordinates of a large model stand for.
#pragma once

#include <string>

#include "core/hdf5_writer.hpp"
#include "eigentrail/model/projection.hpp"

namespace eigentrail {

/// Writes the dimension `freedom`, the basis over it, and what is known of the projection as attributes. The
/// dimension `coordinate` must exist.
void write_projection(Hdf5Writer& file, const Projection& projection);

}  // namespace eigentrail
