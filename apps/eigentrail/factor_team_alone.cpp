// A program that was built without PETSc.
#include <string>

#include "eigentrail/core/errors.hpp"
#include "factor_team.hpp"
#include "launcher.hpp"

namespace eigentrail::app {

int factoring_together(const std::function<int(const SparseSolverMaker&)>& command) {
  const int processes = launched_processes();
  if (processes <= 1) return command({});
  const std::string message =
      std::to_string(processes) +
      " processes were started together, but this eigentrail was built without PETSc, "
      "by which they would factor a large model together; start one, or build it with "
      "-DEIGENTRAIL_PETSC=ON";
  throw InputError(message);
}

}  // namespace eigentrail::app
