// A program that was built without PETSc.
#include "factor_team.hpp"
#include "launcher.hpp"

namespace eigentrail::app {

int factoring_together(const std::function<int(const SparseSolverMaker&)>& command) {
  require_one_process(
      "PETSc, by which they would factor a large model together; start one, or build it with "
      "-DEIGENTRAIL_PETSC=ON");
  return command({});
}

}  // namespace eigentrail::app
