// What a fuzzer calls with every input.
#include <cstddef>
#include <cstdint>

#include "fuzz/entry.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  eigentrail::fuzz::trials().begin()->second({reinterpret_cast<const char*>(data), size});
  return 0;
}
