// Guard modes: eigenvalues that are not followed but come close to one that is. They belong to its block as
// long as both are close.
//
// Modes that enter the selection of a trace: those that come into the chosen band, or become less damped than
// asked for, and those that grow, because the verdict of the trace is about the whole model.
#pragma once

#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/modes/mode_choice.hpp"

namespace eigentrail {

/// Adds those eigenvalues at a point that no track has and that are nearest to a track, as tracks of guard
/// modes behind the others. They are found by inverse iteration about the track; nothing is added to models
/// of more than a thousand freedoms. Cost: an LU of size 2n, and a correction of each.
void add_neighbours(const PathProblem& problem, PathNode& node, std::size_t track, RunCounts& counts);

/// Removes the tracks that consist of guard modes.
void remove_guards(PathNode& node);

/// Joins a track with a mode that is not followed, if it meets one within `reach` steps of signed length h,
/// or if the nearest one is closer than all that are followed. Returns whether it did. Cost: add_neighbours.
bool join_unfollowed(const PathProblem& problem, PathNode& node, std::size_t track, double h, double reach,
                     RunCounts& counts);

struct EnteringModes {
  /// Single modes and blocks. Their `modes` hold numbers from 0 for those that are needed, and Track::guard
  /// for the others.
  std::vector<Track> tracks = {};
  /// Number of growing modes of the whole model that are neither followed nor in `tracks`; -1: not known.
  int growing = -1;
};

/// The modes that enter the selection at a point. Where eigenvalues meet nothing is known. Of a large model
/// only its projection is searched, for modes that the choice wants. Cost: two Cholesky factors where the
/// energy shows that nothing grows and the choice is settled at the start (ModeChoice::may_grow), else a
/// spectrum without vectors, and the correction of every mode with Re s > 0 in it.
EnteringModes entering_modes(const PathProblem& problem, const ModeChoice& choice, const PathNode& node,
                             RunCounts& counts);

/// Follows the entering modes of a step of length h from its end `right` back to its end `left`, alone, or in
/// a block with a mode that they meet on the way or within `reach` steps. Those that are found there are
/// added to it, with new numbers: the step has to be taken again, with them. Returns how many modes were
/// added.
int follow_back(const PathProblem& problem, const std::vector<Track>& entering_modes, double h,
                const PathNode& right, double reach, PathNode& left, ModeNumbers& numbers, RunCounts& counts);

/// Gives numbers to the guard modes of a step's blocks that grow at its right end, at the left end: the step
/// has to be taken again, with them. `right`, `left`: its ends, with the same tracks. Returns how many there
/// are.
int number_growing_guards(const PathProblem& problem, const PathNode& right, PathNode& left,
                          ModeNumbers& numbers);

/// Adds entering modes that could not be followed back to the point where they were noticed. Returns how many
/// modes were added.
int begin_here(const PathProblem& problem, std::vector<Track> entering_modes, PathNode& node,
               ModeNumbers& numbers);

}  // namespace eigentrail
