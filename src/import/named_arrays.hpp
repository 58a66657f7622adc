// Arrays with names, as NumPy and MATLAB store them, and the samples of matrices that they are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "eigentrail/import/importer.hpp"
#include "import/named_array.hpp"

namespace eigentrail {

/// What a user may say about the arrays of a file.
struct ArrayOptions {
  std::string file;           ///< for messages and the title
  bool samples_first = true;  ///< of arrays n x n x n: the first index counts samples, or the last one
};

/// Names and help of the options `parameter`, `unit` and `digits`.
std::map<std::string, std::string> array_options();

/// What the arrays become, for Importer::reads. `cube` is how arrays of all samples are written.
std::vector<ImportedItem> array_items(const std::string& cube);

/// Samples of E and A, or M, C and K, from arrays n x n (one sample, or the same for all), k x n x n or
/// n x n x k, or numbered ones n x n (A00, A01, ...); values of the parameter from a list of k numbers, or
/// numbered ones (w00, w01, ...). Throws InputError that names file and array.
Imported from_arrays(std::vector<NamedArray> arrays, const ArrayOptions& options,
                     const std::map<std::string, std::string>& user_options);

}  // namespace eigentrail
