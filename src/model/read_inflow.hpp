// Reads [[inflow]]: the velocity that rotors induce.
#pragma once

#include <optional>
#include <utility>

#include "model/draft.hpp"

namespace eigentrail {

/// The inflow of a rotor: its element, and what its strips need.
struct InflowDraft {
  std::string name;
  Inflow element;
  RotorDisc disc;
};

/// All [[inflow]] tables, which add their coordinates to the guess. To be called once everything else that
/// has coordinates in triples has been read. `rotation` is the angular velocity of the frame. Without the
/// effect
/// (--without) there are none.
std::vector<InflowDraft> read_inflow(Draft& draft, const std::optional<ExpressionVector>& rotation);

std::vector<FieldHelp> inflow_fields();

}  // namespace eigentrail
