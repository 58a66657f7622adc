// Arrays with names, as NumPy and MATLAB store them, and the samples of matrices that they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "eigentrail/import/importer.hpp"

namespace eigentrail {

/// Numbers or texts. Entry (i, j, ...) stands at i strides[0] + j strides[1] + ...
struct NamedArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<std::size_t> strides;
  std::vector<double> numbers;     ///< empty if the array has texts
  std::vector<std::string> texts;  ///< empty if the array has numbers
  bool is_text = false;

  std::size_t size() const;
  /// Strides of arrays whose last index varies fastest (C), or whose first does (Fortran).
  void set_order(bool last_fastest);
};

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
