// Makes the nodes of a beam, which are bodies, and its elements. [[beam]] and [[blade]] describe beams.
#pragma once

#include "model/beam_table.hpp"

namespace eigentrail {

/// An end of a beam: where it is and what holds it.
struct BeamEnd {
  Place place;
  Carrier carrier;
  ExpressionVector position;  ///< in the frame, at the starting guess
  bool clamped = false;
};

struct BeamDesign {
  std::string name;
  std::array<BeamEnd, 2> ends;
  ExpressionVector y;  ///< direction of the y axis of the sections, as far as it is normal to the beam
  int elements = 10;
  int degree = 2;  ///< nodes per element - 1
  BeamTable sections;
  std::vector<Expression> damping_times = {};  ///< of each strain, s; empty: no damping
};

/// The key `name`, which nothing else may have.
std::string read_beam_name(Draft& draft, TableReader& table);

/// The keys `elements` and `degree`, and what is said of them.
void read_elements(TableReader& table, BeamDesign& design);
std::array<FieldHelp, 2> element_fields();

/// Adds the nodes to the bodies, with their masses and the constraints that hold the ends, and the elements
/// to BeamDraft::sections. `table` is named in messages.
void add_beam(Draft& draft, TableReader& table, const BeamDesign& design);

}  // namespace eigentrail
