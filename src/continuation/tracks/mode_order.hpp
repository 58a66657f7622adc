// Assignment of mode numbers to the eigenvalues of blocks, before and behind a point.
//
// Along a step every eigenvalue is followed continuously from the left end. Where eigenvalues coincide at a
// point, the assignment behind it is made by extrapolation: modes keep their direction through a crossing. On
// the real axis a complex pair becomes two modes, or two real modes become one complex pair.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "continuation/step/step.hpp"

namespace eigentrail {

/// The mode numbers of a trace.
struct ModeNumbers {
  int count = 0;  ///< numbers given so far
  /// For every mode that has become one pair with another, or comes from the same pair: that other one. When
  /// the pair becomes two real modes again, they get the same numbers as before.
  std::map<int, int> partners = {};
};

/// A mode that begins where a complex pair becomes two real modes: the number of the pair, which one of the
/// two keeps, and that of the other.
struct Birth {
  int parent = 0, born = 0;
};

/// Puts the eigenvalues of every block at the end of a step in the order in which they are continued from its
/// beginning, and takes over the mode numbers. Sets Track::told_apart.
void order_arrival(Step& step);

/// Solves for the eigenvalues of a track of a point at a signed distance from it; empty if that fails.
using SolveBehind = std::function<ComplexVector(std::size_t track, double distance)>;

/// Assigns modes behind the end of a step in blocks whose eigenvalues coincide there (`meets`, per track),
/// and sets Track::departure. Returns the modes that begin there. Where rounding hides the eigenvalues so far
/// that the series behind the end are not accurate enough, they are solved for.
std::vector<Birth> order_departure(Step& step, const std::vector<bool>& meets, ModeNumbers& numbers,
                                   const SolveBehind& solve);

/// The same for `node`, the branch point as a start on another path. `arrived`: the branch point at the end
/// of the trace's own path, with the same tracks. `next_step`: signed length of the first step.
std::vector<Birth> order_on_other_path(const PathNode& arrived, double next_step, PathNode& node,
                                       ModeNumbers& numbers);

/// Updates the mode numbers of a real block so that every real eigenvalue is a mode, and of a complex pair
/// the member with Im s > 0. Eigenvalues that are not followed stay guard modes. `in_use`: the modes of all
/// tracks at the point; none of them begins again. Returns the modes that begin, or begin again.
std::vector<Birth> settle_real_block(Track& track, const std::vector<int>& in_use, ModeNumbers& numbers);

/// The modes of all eigenvalues of some tracks.
std::vector<int> modes_of(const std::vector<Track>& tracks);

}  // namespace eigentrail
