// Datasets of a loci file that are written as a whole, at its end: the stable ranges, along the dimension
// `range`, and the errors of the model's data (docs/sampled-families.md).
#pragma once

#include <optional>

#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

/// Creates and writes the datasets of the ranges. The dimension `end` must exist. `unit`: of the traced
/// parameter.
void write_stable_ranges(Hdf5Writer& file, const std::string& unit, const std::vector<StableRange>& ranges);

/// Reads the stable ranges; empty if the file has no such datasets. Throws Hdf5Error if these are
/// inconsistent.
std::optional<std::vector<StableRange>> read_stable_ranges(const Hdf5File& file, std::size_t n_modes);

/// Creates and writes those of the errors. The other datasets of the file must be complete. `unit`: of the
/// traced parameter.
void write_data_errors(Hdf5Writer& file, const std::string& unit, const DataErrors& errors);

/// Empty if the file has no such datasets. Throws Hdf5Error if they do not fit the numbers of steps, modes
/// and events.
std::optional<DataErrors> read_data_errors(const Hdf5File& file, std::size_t steps, std::size_t modes,
                                           std::size_t events);

}  // namespace eigentrail
