// Where memory ends, the program ends with a message. What was saved stays.
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>

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

/// OpenBLAS starts threads when it is loaded, as many as there are cores, and ends the process by a signal
/// where they get no memory. Under a limit of memory the program therefore begins once more without them; it
/// has threads of its own.
void begin_without_threads_of_blas(int /*argc*/, char** argv, char** environment) {
  constexpr const char* variable = "OPENBLAS_NUM_THREADS=1";
  constexpr std::size_t name = 21, most_variables = 4096;
  rlimit memory{};
  if (getrlimit(RLIMIT_AS, &memory) != 0 || memory.rlim_cur == RLIM_INFINITY) return;
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

}  // namespace
}  // namespace eigentrail::app
