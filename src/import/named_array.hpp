// An array with a name, as NumPy and MATLAB store it.
#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace eigentrail {

/// Numbers or texts. Entry (i, j, ...) stands at i strides[0] + j strides[1] + ...
struct NamedArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<std::size_t> strides;
  std::vector<double> numbers;     ///< empty if the array has texts
  std::vector<std::string> texts;  ///< empty if the array has numbers
  bool is_text = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.name, self.shape, self.strides, self.numbers, self.texts, self.is_text);
  }

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
