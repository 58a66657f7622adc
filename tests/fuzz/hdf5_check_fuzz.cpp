// Bytes as an HDF5 file: the checks before the HDF5 library opens it.
#include "core/hdf5_check/check.hpp"
#include "core/hdf5_file.hpp"
#include "fuzz/entry.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    eigentrail::check_hdf5_bytes(eigentrail::fuzz::as_text(data, size));
  } catch (const eigentrail::Hdf5Error&) {
  }
  return 0;
}
