// Reads sparse matrices of HDF5 files.
#pragma once

#include <string>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/system_matrix.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Whether a matrix of the file is sparse: a group with the datasets data, indices and indptr, as
/// scipy.sparse.csr_matrix.
bool is_compressed(const Hdf5File& file, const std::string& path);

/// How many numbers a sparse matrix has; 0 where it has no list of them.
std::size_t compressed_numbers(const Hdf5File& file, const std::string& path);

/// The matrix, square, of at most `most_rows` rows. For every fault throws an InputError about the key `file`
/// of the table.
SparseMatrix read_compressed_rows(const Hdf5File& file, const std::string& path, Eigen::Index most_rows,
                                  const TableReader& table);

}  // namespace eigentrail
