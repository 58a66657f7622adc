// Matrices from MATLAB's files of variables.
#include "core/reader_process.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "import/formats.hpp"
#include "import/named_arrays.hpp"

namespace eigentrail {
namespace {

std::vector<NamedArray> read_variables(const std::string& path) {
  require_plain_file(path);
  const ReaderProcess reader(path);
  auto arrays = reader.ask<std::vector<NamedArray>>(ReaderRequest::matlab, path);
  for (const NamedArray& array : arrays) {
    if (array.strides.size() != array.shape.size() ||
        array.size() != (array.is_text ? array.texts.size() : array.numbers.size()))
      reader.fail("variable " + array.name + " is damaged");
  }
  return arrays;
}

Imported read_matlab(const ImportRequest& request) {
  if (request.files.size() != 1) throw InputError("matlab: expected one .mat file with all samples");
  return from_arrays(read_variables(request.files.front()), request, false);
}

}  // namespace

Importer matlab_importer() {
  std::vector<ImportedItem> items = array_items("n x n x k, as A(:,:,i)");
  items.push_back({"a structure", "its fields are read like variables"});
  return {"matlab", "matrices from a file of MATLAB (.mat)", items, array_options(), read_matlab};
}

}  // namespace eigentrail
