// What the environment says of processes that mpirun or srun has started together.
#pragma once

#include <string>

namespace eigentrail::app {

/// Whether a launcher has started this process, alone or with others.
bool launched();

/// How many processes the launcher has started together; 0 if there is none, or if it does not say.
int launched_processes();

/// Throws InputError if several processes were started together, which this program cannot use: it was built
/// without `what`, and what to do then.
void require_one_process(const std::string& what);

}  // namespace eigentrail::app
