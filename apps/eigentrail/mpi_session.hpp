// MPI between its beginning and its end.
#pragma once

#include <mpi.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace eigentrail::app {

/// Open MPI's layer `cm`, for networks that match messages themselves, waits 0.2 s for their hardware.
/// Processes of one machine do without it. A layer that the user has chosen stays.
inline void leave_out_the_network_on_one_machine() {
  const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
  constexpr int keep = 0;
  if (here != nullptr && all != nullptr && std::string(here) == all) setenv("OMPI_MCA_pml", "^cm", keep);
}

class MpiSession {
 public:
  /// `threads`: what MPI must allow them. Throws std::runtime_error if it does not.
  explicit MpiSession(int threads) {
    leave_out_the_network_on_one_machine();
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, threads, &provided);
    if (provided >= threads) return;
    MPI_Finalize();
    throw std::runtime_error("MPI: expected one that several threads may call (MPI_THREAD_MULTIPLE)");
  }
  ~MpiSession() { MPI_Finalize(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

}  // namespace eigentrail::app
