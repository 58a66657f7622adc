#include "core/blas.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <mutex>
#include <vector>

// Defined only if LAPACK is OpenBLAS.
extern "C" void* blas_memory_alloc(int) __attribute__((weak));   // NOLINT: its name
extern "C" void blas_memory_free(void*) __attribute__((weak));   // NOLINT
extern "C" char* openblas_get_corename() __attribute__((weak));  // NOLINT

namespace eigentrail {
namespace {

/// Asks the system for as much as OpenBLAS will, in the same way.
bool has_room_for_buffer() {
  constexpr std::size_t buffer = 128U << 20U;
  void* const tried = mmap(nullptr, buffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return tried != MAP_FAILED && munmap(tried, buffer) == 0;
}

}  // namespace

bool blas_has_memory_for(std::size_t threads) {
  static std::mutex mutex;
  static std::size_t known = 0;
  if (blas_memory_alloc == nullptr || blas_memory_free == nullptr) return true;
  const std::scoped_lock lock(mutex);
  std::vector<void*> taken;
  // OpenBLAS keeps what is given back, and gives it to the next one who asks.
  while (taken.size() < threads && (taken.size() < known || has_room_for_buffer()))
    taken.push_back(blas_memory_alloc(0));
  for (void* const buffer : taken) blas_memory_free(buffer);
  known = std::max(known, taken.size());
  return taken.size() == threads;
}

std::string blas_kernel() {
  return openblas_get_corename == nullptr ? "other" : openblas_get_corename();
}

}  // namespace eigentrail
