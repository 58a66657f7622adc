// What HDF5 files of eigentrail hold.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A failed HDF5 call, or a file that cannot be read. The message says what was tried, on which object and in
/// which file.
class Hdf5Error : public InputError {
 public:
  using InputError::InputError;
};

/// Complex numbers are stored as the compound {r, i}, which h5py reads as complex128.
enum class ElementType { real, complex, integer, text };

using Shape = std::vector<std::uint64_t>;

/// Elements of one type; alternatives in the order of ElementType.
using StoredElements = std::variant<std::vector<double>, std::vector<Complex>, std::vector<std::int64_t>,
                                    std::vector<std::string>>;

template <class Element>
ElementType element_type() {
  return static_cast<ElementType>(StoredElements(std::vector<Element>()).index());
}

inline StoredElements no_elements(ElementType type) {
  const StoredElements all[] = {std::vector<double>(), std::vector<Complex>(), std::vector<std::int64_t>(),
                                std::vector<std::string>()};
  return all[static_cast<std::size_t>(type)];
}

/// A dataset, the first rows of one, or an attribute. A single value has no dimensions.
struct StoredArray {
  Shape shape;
  StoredElements elements;  ///< row-major
};

/// Largest number of elements that is read from one dataset.
inline constexpr std::uint64_t max_elements = std::uint64_t{1} << 31U;

/// Number of elements of a shape, limited to max_elements + 1 so that large shapes do not overflow.
inline std::uint64_t element_count(const Shape& shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t dimension : shape) {
    if (dimension != 0 && count > max_elements / dimension) return max_elements + 1;
    count *= dimension;
  }
  return count;
}

}  // namespace eigentrail
