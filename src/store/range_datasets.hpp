// Stable ranges in a loci file: the datasets along the dimension `range`.
#pragma once

#include <optional>

#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

/// Creates and writes the datasets. The dimension `end` must exist. `unit`: of the traced parameter.
void write_stable_ranges(Hdf5Writer& file, const std::string& unit, const std::vector<StableRange>& ranges);

/// Reads the stable ranges; empty if the file has no such datasets. Throws Hdf5Error if these are
/// inconsistent.
std::optional<std::vector<StableRange>> read_stable_ranges(const Hdf5File& file, std::size_t n_modes);

}  // namespace eigentrail
