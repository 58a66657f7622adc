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
    if (provided < threads) {
      MPI_Finalize();
      throw std::runtime_error("MPI: expected one that several threads may call (MPI_THREAD_MULTIPLE)");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiSession() { MPI_Finalize(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// Whether this is the first process.
  bool leads() const { return rank_ == 0; }
  int size() const { return size_; }

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace eigentrail::app
