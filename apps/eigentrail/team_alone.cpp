// A program that was built without MPI.
#include "launcher.hpp"
#include "team.hpp"

namespace eigentrail::app {

int together(const std::function<int(Team&)>& command) {
  require_one_process("MPI; build it with -DEIGENTRAIL_MPI=ON, or share the work with --part");
  return alone(command);
}

}  // namespace eigentrail::app
