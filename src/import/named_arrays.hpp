// Arrays with names, as NumPy and MATLAB store them, and the samples of matrices that they are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "eigentrail/import/importer.hpp"
#include "import/named_array.hpp"

namespace eigentrail {

/// Names and help of the options `parameter`, `unit` and `digits`.
std::map<std::string, std::string> array_options();

/// What the arrays become, for Importer::reads. `cube` is how arrays of all samples are written.
std::vector<ImportedItem> array_items(const std::string& cube);

/// Samples of E and A, or M, C and K, from arrays n x n (one sample, or the same for all), k x n x n or
/// n x n x k, or numbered ones n x n (A00, A01, ...); values of the parameter from a list of k numbers, or
/// numbered ones (w00, w01, ...). The request has one file, which the arrays are from. `samples_first`: of
/// arrays n x n x n the first index counts samples, not the last one. Throws InputError that names file and
/// array.
Imported from_arrays(const std::vector<NamedArray>& arrays, const ImportRequest& request, bool samples_first);

}  // namespace eigentrail
