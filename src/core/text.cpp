#include "eigentrail/core/text.hpp"

#include <array>
#include <charconv>

namespace eigentrail {

std::string exact_text(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace eigentrail
