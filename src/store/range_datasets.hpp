// Stable ranges in a loci file: the datasets along the dimension `range`.
#pragma once

#include <optional>

#include "core/hdf5_file.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

/// Creates and writes the datasets. Dimension `end` and the traced parameter's dataset exist.
void write_stable_ranges(Hdf5File& file, const std::string& parameter,
                         const std::vector<StableRange>& ranges);

/// Reads them back; empty when the file has none. Throws Hdf5Error when they do not fit each other.
std::optional<std::vector<StableRange>> read_stable_ranges(const Hdf5File& file, std::size_t n_modes);

/// Whether a dataset of this name is one of them.
bool is_range_dataset(const std::string& name);

}  // namespace eigentrail
