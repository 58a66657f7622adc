// Files of arrays with names, for other programs.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/linear_model.hpp"
#include "output_choice.hpp"

namespace eigentrail::app {

/// The files to write for an output, with the format that each one may replace. Its ending says which: .npz
/// of NumPy, arrays of all samples k x n x n; .mat of MATLAB (version 5), n x n x k; .json, lists. Without an
/// ending it is a folder: a file of Matrix Market for each matrix, and model.json with the rest. Of one
/// sample matrices are n x n. Throws InputError for another ending, for several samples in a folder, and for
/// a folder with other matrices.
struct ArrayFile {
  std::string path;
  OutputFormat format;
  std::string bytes;
};
std::vector<ArrayFile> array_files(const std::string& output, std::vector<NamedSamples> arrays);

/// Whether arrays can be written to an output: throws as array_files does.
void check_array_output(const std::string& output, std::size_t samples);

}  // namespace eigentrail::app
