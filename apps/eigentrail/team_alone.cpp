// A program that was built without MPI.
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string>

#include "eigentrail/core/errors.hpp"
#include "team.hpp"

namespace eigentrail::app {
namespace {

/// The number in one of these environment variables, which the launchers of Open MPI and MPICH set; 0: none.
int number_in(std::initializer_list<const char*> names) {
  int number = 0;
  for (const char* name : names) {
    const char* text = std::getenv(name);
    if (text != nullptr) number = std::max(number, std::atoi(text));
  }
  return number;
}

}  // namespace

int together(const std::function<int(Team&)>& command) {
  const int processes = number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
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
