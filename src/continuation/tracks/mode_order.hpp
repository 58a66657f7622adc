// Which eigenvalue of a block is which mode, on both sides of a point.
//
// Along a step every eigenvalue is followed from the left end. Where eigenvalues meet at a point, who is who
// behind it is decided anew: straight on through a crossing; on the real axis a pair becomes two modes, or
// two modes become a pair.
#pragma once

#include <map>
#include <vector>

#include "continuation/step/step.hpp"

namespace eigentrail {

/// The modes of a trace: how many there are, and which two shared a pair of real eigenvalues, so that the
/// same mode comes back when a pair parts again.
struct ModeNumbers {
  int count = 0;
  std::map<int, int> partners = {};
};

/// A mode that begins where a pair comes apart on the real axis.
struct Birth {
  int parent = 0, born = 0;
};

/// Orders the eigenvalues of every block at the end of a step as they come from its beginning.
void order_arrival(Step& step);

/// Orders the modes behind the end of a step in those blocks whose eigenvalues meet there (`meets`, per
/// track). Returns the modes that begin there.
std::vector<Birth> order_departure(Step& step, const std::vector<bool>& meets, ModeNumbers& numbers);

/// Orders the modes of a point on another path, with the tracks of `arrived`, at which the trace leaves its
/// own. `next_step`: signed length of the first step. Returns the modes that begin there.
std::vector<Birth> order_on_other_path(const PathNode& arrived, double next_step, PathNode& node,
                                       ModeNumbers& numbers);

/// In a real block every real eigenvalue is a mode, and of a complex pair the upper member is one. Returns
/// the modes that begin, or begin again.
std::vector<Birth> settle_real_block(Track& track, ModeNumbers& numbers);

}  // namespace eigentrail
