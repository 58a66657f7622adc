#include "launcher.hpp"

#include <algorithm>
#include <cstdlib>

#include "eigentrail/core/errors.hpp"

namespace eigentrail::app {

bool launched() {
  // Open MPI, MPICH and Slurm set one of these.
  const auto names = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};
  return std::ranges::any_of(names, [](const char* name) { return std::getenv(name) != nullptr; });
}

int launched_processes() {
  int number = 0;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* text = std::getenv(name);
    if (text != nullptr) number = std::max(number, std::atoi(text));
  }
  return number;
}

void require_one_process(const std::string& what) {
  const int processes = launched_processes();
  if (processes > 1)
    throw InputError(std::to_string(processes) +
                     " processes were started together, but this eigentrail was built without " + what);
}

}  // namespace eigentrail::app
