// Compiled into programs, not into the library: an allocation that fails does not return.
#include "core/ending_allocation.hpp"

// The functions of glibc under their second names.
extern "C" void* __libc_malloc(std::size_t size);                           // NOLINT
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
extern "C" void* __libc_realloc(void* memory, std::size_t size);            // NOLINT
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

namespace {

void* existing(void* memory, std::size_t size) {
  if (memory == nullptr && size > 0) eigentrail::end_without_memory(size);
  return memory;
}

}  // namespace

// NOLINTBEGIN: as POSIX has them
extern "C" {
void* malloc(std::size_t size) {
  return existing(__libc_malloc(size), size);
}
void* calloc(std::size_t count, std::size_t size) {
  return existing(__libc_calloc(count, size), count == 0 ? 0 : size);
}
void* realloc(void* memory, std::size_t size) {
  return existing(__libc_realloc(memory, size), size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return existing(__libc_memalign(alignment, size), size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return 0;
}
}
// NOLINTEND
