// Modes of copies of a part. Of equal parts one is traced; a mode of it stands for the equal ones of its
// copies, which have numbers of their own in everything that a trace hands out: events, steps, and the modes
// of a point one by one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/continuation/trace_result.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

/// Numbers of the modes that a trace's modes stand for.
struct ModeCopies {
  /// By mode: the number of the equal mode in every copy of its part. At the end of the list copies are
  /// missing whose mode is not followed.
  std::map<int, std::vector<int>> numbers = {};

  const std::vector<int>& of(int mode) const;
};

/// The copies of the modes at the start: the first `n_modes` of the spectrum are followed.
ModeCopies starting_copies(const std::vector<StartingMode>& modes, int n_modes);

/// Gives numbers to the copies of the modes of a point that have none yet. A mode that begins where a pair
/// becomes two modes has as many as the other one of the two.
void number_copies(const PathNode& node, ModeNumbers& numbers, ModeCopies& copies);

/// A step with the blocks of the copies.
PathStep with_copies(const ModeCopies& copies, PathStep step);

/// Events with those of the copies. An event of modes of one part happens in every copy; one of several
/// parts, and one of the path as a whole, is a single event of all equal modes.
std::vector<Event> with_copies(const ModeCopies& copies, const Event& event);

/// " and the equal modes 4, 5" for the copies of some modes, counted from 1; empty if there are none.
std::string equal_modes_text(const ModeCopies& copies, const std::vector<int>& modes);

/// Every mode that exists before or behind the point, those of `copies` included. `traced`: index of the
/// traced parameter. `along`: error of the place on the path by rounding, in its coordinate, which is one of
/// the eigenvalues, too.
std::vector<ModeState> mode_states(const PathNode& node, int traced, const ModeCopies& copies = {},
                                   const RoundingThresholds& thresholds = {}, double along = 0.0);

}  // namespace eigentrail
