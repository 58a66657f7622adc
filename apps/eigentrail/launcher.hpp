// What the environment says of processes that mpirun or srun has started together.
#pragma once

namespace eigentrail::app {

/// Whether a launcher has started this process, alone or with others.
bool launched();

/// How many processes the launcher has started together; 0 if there is none, or if it does not say.
int launched_processes();

}  // namespace eigentrail::app
