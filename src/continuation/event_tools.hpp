// What the stages that look for special points share.
#pragma once

#include <cstdint>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

constexpr int most_retrackings = 8;
constexpr double settled = 1e-13;  ///< of the range: a special point is located when it moves by less

/// Books the factorizations between construction and destruction under events.
class EventWork {
 public:
  explicit EventWork(RunCounts& counts) : counts_(counts), before_(counts.modes.factorizations) {}
  ~EventWork() {
    counts_.event_factorizations += counts_.modes.factorizations - before_;
    counts_.modes.factorizations = before_;
  }
  EventWork(const EventWork&) = delete;
  EventWork& operator=(const EventWork&) = delete;

 private:
  RunCounts& counts_;
  std::uint64_t before_;
};

/// The modes among members of a block, ascending, each once.
std::vector<int> sorted_modes(const std::vector<int>& modes);

/// Elements of either, ascending; both are ascending.
std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b);

/// The eigenvalues of a track with these indices.
std::vector<Complex> roots_of(const Track& track, const std::vector<int>& members);

/// A point with some of its tracks only: what an event needs.
PathNode with_tracks(const PathNode& node, const std::vector<std::size_t>& tracks);

}  // namespace eigentrail
