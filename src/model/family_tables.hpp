// What the readers of families of matrices have in common.
#pragma once

#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "eigentrail/model/model.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// The only table [name] of a scene that has the key. Throws InputError for an empty list, or several.
const Table& only_table(const Scene& scene, const std::string& name);

/// Index of the parameter that [trace] of the scene names. `what` says in the error what it is in a scene
/// with the table [name].
int traced_index(const Scene& scene, const std::string& name, const std::string& what);

/// Why a member of an HDF5 file that is not known is refused: a misspelt group would otherwise count as a
/// matrix that is zero. Empty if all are known.
std::string unknown_member(const Hdf5File& file, const std::vector<std::string>& known);

/// Why names of n states are refused: too many or too few of them, or one that is there twice. Empty for good
/// names, and for none.
std::string fault_of_names(const std::vector<std::string>& names, Eigen::Index n);

/// A description with n coordinates: x1, x2, ... and the unit 1 where names and units are empty.
ModelDescription describe_states(Eigen::Index n, const std::vector<std::string>& names,
                                 const std::vector<std::string>& units = {});

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
