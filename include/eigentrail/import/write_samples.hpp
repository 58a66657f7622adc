// Writes samples of matrices to the HDF5 file that [sampled_family] reads (docs/sampled-families.md).
#pragma once

#include <string>

#include "eigentrail/model/sampled_data.hpp"

namespace eigentrail {

/// Replaces the file atomically. Throws std::invalid_argument if the samples do not fit each other (check),
/// and std::runtime_error if the file cannot be written.
void write_samples(const std::string& path, const SampledData& data);

}  // namespace eigentrail
