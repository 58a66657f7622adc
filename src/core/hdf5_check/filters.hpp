// Compression and checksums of a dataset's chunks.
#pragma once

#include <vector>

#include "core/hdf5_check/bytes.hpp"

namespace eigentrail::hdf5_check {

/// Numbers of filters in the order in which they were applied.
using Filters = std::vector<unsigned>;

/// Accepts deflate, shuffle and fletcher32, each once at most.
Filters read_filters(Cursor data);

/// Checks that a stored chunk becomes exactly `size` bytes: HDF5 would read past the end of a shorter one.
/// `skipped` has a bit for every filter that was not applied.
void check_chunk(const Filters& filters, std::uint64_t skipped, Cursor stored, std::uint64_t size);

}  // namespace eigentrail::hdf5_check
