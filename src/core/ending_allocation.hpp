// Where memory ends, a program ends. Few libraries stand it: HDF5 1.10 crashes in the call in which it
// happens, and again when it cleans up at the exit.
#pragma once

#include <cstddef>

namespace eigentrail {

/// Ends the program, which defines it: `size` more bytes were needed and are not there. It must not allocate.
[[noreturn]] void end_without_memory(std::size_t size);

}  // namespace eigentrail
