// Modes of a large model that are not followed and come among the followed ones.
#pragma once

#include <vector>

#include "eigentrail/continuation/trace_result.hpp"
#include "eigentrail/projection/project.hpp"
#include "projection/large_model.hpp"

namespace eigentrail {

/// Eigenvalues below this share of the largest one beside them are rigid-body motions: nobody asks for them.
inline constexpr double rigid = 1e-6;

struct ModeEntries {
  int count = 0;                ///< how often a mode comes among the followed ones
  double from = 0.0, to = 0.0;  ///< places between which the first one does
  double frequency = 0.0;       ///< its Im s, rad/s
};

/// Modes that come nearer to `centre` than the farthest followed one, at places in the order of the path.
/// `reference`: magnitude below which an eigenvalue counts as zero, 1/s.
ModeEntries find_mode_entries(const LargeModel& large, const Model& model,
                              const std::vector<ProjectedPlace>& places, const Shift& centre,
                              double reference);

}  // namespace eigentrail
