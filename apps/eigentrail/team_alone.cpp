// A program that was built without MPI.
#include <string>

#include "eigentrail/core/errors.hpp"
#include "launcher.hpp"
#include "team.hpp"

namespace eigentrail::app {

int together(const std::function<int(Team&)>& command) {
  const int processes = launched_processes();
  if (processes > 1) {
    const std::string message =
        std::to_string(processes) +
        " processes were started together, but this eigentrail was built without MPI; build it with "
        "-DEIGENTRAIL_MPI=ON, or share the work with --part";
    throw InputError(message);
  }
  return alone(command);
}

}  // namespace eigentrail::app
