// How the program uses memory, and what happens where it ends: the program ends with a message, and what was
// saved stays.
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "commands.hpp"
#include "core/ending_allocation.hpp"

namespace eigentrail {

void end_without_memory(std::size_t size) {
  std::array<char, 128> text{};
  const int length = std::snprintf(
      text.data(), text.size(),
      "eigentrail: not enough memory: %zu more bytes were needed; what was saved stays\n", size);
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), static_cast<std::size_t>(length));
  _exit(app::numbers_failed);
}

}  // namespace eigentrail

namespace eigentrail::app {
namespace {

bool has_limited_memory() {
  rlimit memory{};
  return getrlimit(RLIMIT_AS, &memory) == 0 && memory.rlim_cur != RLIM_INFINITY;
}

/// OpenBLAS starts threads when it is loaded, as many as there are cores, and ends the process by a signal
/// where they get no memory. Under a limit of memory the program therefore begins once more without them; it
/// has threads of its own.
void begin_without_threads_of_blas(int /*argc*/, char** argv, char** environment) {
  constexpr const char* variable = "OPENBLAS_NUM_THREADS=1";
  constexpr std::size_t name = 21, most_variables = 4096;
  if (!has_limited_memory()) return;
  std::array<char*, most_variables> variables{};
  std::size_t count = 0;
  for (; environment[count] != nullptr; ++count) {
    if (std::strncmp(environment[count], variable, name) == 0 || count + 2 >= most_variables) return;
    variables[count] = environment[count];
  }
  variables[count] = const_cast<char*>(variable);
  execve("/proc/self/exe", argv, variables.data());
}

/// What the system calls before the constructors of the libraries.
__attribute__((section(".preinit_array"), used)) auto* const first = &begin_without_threads_of_blas;

#ifdef __GLIBC__
/// Memory of temporaries is kept for the next ones. By default glibc gives blocks of 128 KiB and more, and
/// all at the end of the heap, back to the system at once, and takes memory little by little, in pages of 4
/// KiB; page faults were up to a third of the time of rotors and wings. Without a limit of memory the heap
/// begins with room for a large model, in huge pages where the system has them.
bool keep_memory_of_temporaries() {
  constexpr int largest_block = 1 << 25;  // glibc takes no larger one
  constexpr int kept = 1 << 28;
  constexpr std::uintptr_t huge_page = 1 << 21;
  if (mallopt(M_MMAP_THRESHOLD, largest_block) == 0 || mallopt(M_TRIM_THRESHOLD, kept) == 0) return false;
  if (has_limited_memory()) return false;
  const auto begin = reinterpret_cast<std::uintptr_t>(sbrk(0)) / huge_page * huge_page + huge_page;
  mallopt(M_TOP_PAD, kept);
  void* volatile first_block = std::malloc(huge_page);  // else the compiler leaves both calls out
  std::free(first_block);
  return madvise(reinterpret_cast<void*>(begin), kept - huge_page, MADV_HUGEPAGE) == 0;
}

[[maybe_unused]] const bool keeps_memory = keep_memory_of_temporaries();
#endif

}  // namespace
}  // namespace eigentrail::app
