// Compression and checksums of a dataset's chunks.
#pragma once

#include <vector>

#include "core/hdf5_check/bytes.hpp"

namespace eigentrail::hdf5_check {

/// Filter identifiers in the order in which they were applied.
using Filters = std::vector<unsigned>;

/// Accepts deflate, shuffle and fletcher32, each at most once; refuses other filters.
Filters read_filters(Cursor data);

/// Checks that a stored chunk decompresses to exactly `size` bytes; HDF5 would read past the end of a shorter
/// one. Each bit of `skipped` marks a filter that was not applied.
void check_chunk(const Filters& filters, std::uint64_t skipped, Cursor stored, std::uint64_t size);

}  // namespace eigentrail::hdf5_check
