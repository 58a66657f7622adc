// Reads a [matrix_family] whose file has sparse matrices, or matrices with factors.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "core/hdf5_file.hpp"
#include "eigentrail/model/model.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Whether a matrix of the file is sparse: a group with the datasets data, indices and indptr.
bool has_sparse_matrices(const Hdf5File& file);

/// Reads the family: /M/0, /C/1, ... are coefficients of powers of the parameter with index `variable`;
/// matrices with other names, such as /K/bearing, are multiplied by the factor of this name in the table
/// `factors`. `used` is the set of parameters that the table collects. Each is sparse (rows compressed) or
/// dense. Throws InputError for every fault.
std::unique_ptr<Model> read_sparse_family(const Scene& scene, TableReader& table, const Hdf5File& file,
                                          int variable, std::set<int>& used);

}  // namespace eigentrail
