// Modes that come into the chosen band, or become less damped than asked for, after the trace has begun.
#pragma once

#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/modes/mode_choice.hpp"

namespace eigentrail {

/// Tracks of modes at the end of a step that the choice wants and nobody follows, or blocks with such modes.
/// Empty where the choice is settled at the start (ModeChoice::may_grow) or eigenvalues meet at the point.
/// Their `modes` hold numbers from 0 for those that are wanted, as guests the others. Cost: a spectrum
/// without vectors.
std::vector<Track> newcomers(const PathProblem& problem, const ModeChoice& choice, const PathNode& node,
                             RunCounts& counts);

/// Follows the newcomers of a step back to its left end `left`. Those that are found there are added to it,
/// with new numbers: the step has to be taken again, with them. Returns how many modes were added.
int follow_back(const PathProblem& problem, const std::vector<Track>& newcomers, double h, PathNode& left,
                ModeNumbers& numbers, RunCounts& counts);

/// Adds newcomers that could not be followed back to the point where they were noticed. Returns how many
/// modes were added.
int begin_here(const PathProblem& problem, std::vector<Track> newcomers, PathNode& node,
               ModeNumbers& numbers);

}  // namespace eigentrail
