// Reads the tables of wings and blades in moving air: [[strips]], [[lift_lag]], [[apparent_mass]].
#pragma once

#include <optional>
#include <utility>

#include "model/read_inflow.hpp"

namespace eigentrail {

/// The strips of a [[strips]] table.
struct StripTable {
  std::string name;
  std::vector<Strip> strips;

  /// Name of the strip with index i.
  std::string label(std::size_t i) const { return name + ", strip " + std::to_string(i + 1); }
};

/// All [[strips]] tables; beams and bodies must have been read. `rotation` is the angular velocity of the
/// frame.
std::vector<StripTable> read_strip_tables(Draft& draft, const std::optional<ExpressionVector>& rotation,
                                          std::vector<InflowDraft>& inflows);

/// What other tables add to strips, with labels.
std::vector<std::pair<LiftLag, std::string>> read_lift_lag(Draft& draft,
                                                           const std::vector<StripTable>& tables);
std::vector<std::pair<ApparentMass, std::string>> read_apparent_mass(Draft& draft,
                                                                     const std::vector<StripTable>& tables);

/// Keys of these tables.
std::vector<FieldHelp> strips_fields();
std::vector<FieldHelp> lift_lag_fields();
std::vector<FieldHelp> apparent_mass_fields();

}  // namespace eigentrail
