// An array with a name, as NumPy and MATLAB store it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace eigentrail {

/// A number of so many bytes in memory, the lowest ones of `bits`: real ('f'), signed ('i') or unsigned.
inline double stored_number(std::uint64_t bits, std::size_t bytes, char kind) {
  if (kind == 'f' && bytes == 4) return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  if (kind == 'f') return std::bit_cast<double>(bits);
  const std::size_t unused = 64 - 8 * bytes;  // the sign is the highest of the other bits
  return kind == 'i' ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                     : static_cast<double>(bits);
}

/// Numbers or texts. Entry (i, j, ...) stands at i strides[0] + j strides[1] + ...
struct NamedArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<std::size_t> strides;
  std::vector<double> numbers;     ///< empty if the array has texts
  std::vector<std::string> texts;  ///< empty if the array has numbers
  bool is_text = false;

  std::size_t size() const {
    return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  }
  /// Strides of arrays whose last index varies fastest (C), or whose first does (Fortran).
  void set_order(bool last_fastest) {
    strides.assign(shape.size(), 1);
    std::size_t stride = 1;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const std::size_t i = last_fastest ? shape.size() - 1 - k : k;
      strides[i] = stride;
      stride *= shape[i];
    }
  }
};

}  // namespace eigentrail
