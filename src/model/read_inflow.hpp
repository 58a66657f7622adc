// Reads [[inflow]]: the velocity that rotors induce.
#pragma once

#include <optional>

#include "model/draft.hpp"

namespace eigentrail {

/// The inflow of a rotor: its element, and what its strips need.
struct InflowDraft {
  std::string name;
  Inflow element;
  RotorDisc disc;
  bool annular = false;   ///< every strip has an annulus of its own, and `element` has no coordinates
  bool tip_loss = false;  ///< of annuli
  Expression guess, radius;
  Expression blades;      ///< of the rotor, for the loss at the tips
  int sense = 1;          ///< with [rotor]: that of the axis along the axis of rotation
  int first_triple = -1;  ///< of the blade whose strips have the annuli
  std::vector<Inflow> annuli = {};

  /// Name of the annulus with index i.
  std::string label(std::size_t i) const { return name + ", annulus " + std::to_string(i + 1); }
};

/// Gives a strip of this length along the radius an annulus of its own, at its place in the guess.
void add_annulus(Draft& draft, const TableReader& table, InflowDraft& inflow, Strip& strip,
                 const Expression& width);

/// All [[inflow]] tables, which add their coordinates to the guess. To be called once everything else that
/// has coordinates in triples has been read. `rotation` is the angular velocity of the frame. Without the
/// effect
/// (--without) there are none.
std::vector<InflowDraft> read_inflow(Draft& draft, const std::optional<ExpressionVector>& rotation);

std::vector<FieldHelp> inflow_fields();

}  // namespace eigentrail
