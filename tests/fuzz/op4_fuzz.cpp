// Bytes as a file of Nastran's OUTPUT4, text or binary.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/op4.hpp"

EIGENTRAIL_FUZZ(op4) {
  try {
    (void)eigentrail::parse_op4(bytes, "a.op4", [](const std::string& name) { return name != "SKIP"; });
  } catch (const eigentrail::InputError&) {
  }
}
