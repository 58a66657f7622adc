// Bytes as an array of NumPy, and as the samples that it may be.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/npy.hpp"

EIGENTRAIL_FUZZ(npy) {
  try {
    (void)eigentrail::announced_npy_bytes(bytes, "A");
    eigentrail::NamedArray array = eigentrail::read_npy(bytes, "A");
    array.name = "A";
    eigentrail::NamedArray parameter{"parameter", {array.shape.empty() ? 1 : array.shape[0]}, {1}, {}, {},
                                     false};
    if (parameter.shape[0] > 1000) return;
    for (std::size_t i = 0; i < parameter.shape[0]; ++i) parameter.numbers.push_back(static_cast<double>(i));
    (void)eigentrail::from_arrays({array, parameter}, {{"a.npz"}, {}}, true);
  } catch (const eigentrail::InputError&) {
  }
}
