// The processes that carry out one command together: this one alone, or those that mpirun has started.
//
// Only the implementation knows MPI. A command asks its team for workers, and for whether this process leads:
// the leading process prints and writes the files, the others are silent.
#pragma once

#include <functional>
#include <memory>

#include "eigentrail/core/workers.hpp"

namespace eigentrail::app {

/// This process alone, unless a function is overridden.
class Team {
 public:
  virtual ~Team() = default;
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Workers of all processes; `jobs` threads in each process, 0: one per core that the process has for
  /// itself.
  virtual std::unique_ptr<Workers> workers(int jobs) { return std::make_unique<Threads>(jobs); }

  /// Whether this process prints and writes; true in one process.
  virtual bool leads() const { return true; }
};

/// Runs a command in the team of this process. If the processes were started by mpirun, an error in one of
/// them ends all; one message is printed. Returns the exit code of the command. Throws InputError if several
/// processes were started and the program was built without MPI.
int together(const std::function<int(Team&)>& command);

/// Runs a command in this process alone.
inline int alone(const std::function<int(Team&)>& command) {
  Team team;
  return command(team);
}

}  // namespace eigentrail::app
