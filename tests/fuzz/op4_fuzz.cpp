// Bytes as a file of Nastran's OUTPUT4, text or binary.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/op4.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)eigentrail::parse_op4(eigentrail::fuzz::as_text(data, size), "a.op4",
                                [](const std::string& name) { return name != "SKIP"; });
  } catch (const eigentrail::InputError&) {
  }
  return 0;
}
