// The nodes of shafts in a loci file: names, places, and their coordinates.
#pragma once

#include "core/hdf5_writer.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// Writes the nodes of a model with shafts; nothing for others.
void write_shafts(Hdf5Writer& file, const ModelDescription& description);

}  // namespace eigentrail
