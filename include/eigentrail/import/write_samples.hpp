// Writes samples of matrices to the HDF5 file that [sampled_family] reads (docs/sampled-families.md).
#pragma once

#include <string>

#include "eigentrail/model/sampled_data.hpp"

namespace eigentrail {

/// Writes a new file. Throws std::invalid_argument if the samples do not fit each other (check), and
/// std::runtime_error if the file is there or cannot be written.
void write_samples(const std::string& path, const SampledData& data);

}  // namespace eigentrail
