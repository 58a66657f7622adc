// Errors of the model's data in a loci file (docs/sampled-families.md).
#pragma once

#include <optional>

#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/continuation/data_errors.hpp"

namespace eigentrail {

/// Creates and writes the datasets. The other datasets of the file must be complete. `unit`: of the traced
/// parameter.
void write_data_errors(Hdf5Writer& file, const std::string& unit, const DataErrors& errors);

/// Empty if the file has no such datasets. Throws Hdf5Error if they do not fit the numbers of steps, modes
/// and events.
std::optional<DataErrors> read_data_errors(const Hdf5File& file, std::size_t steps, std::size_t modes,
                                           std::size_t events);

}  // namespace eigentrail
