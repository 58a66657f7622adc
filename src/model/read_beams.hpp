// Reads [[beam]]: makes the nodes of a beam, which are bodies, and its elements.
#pragma once

#include "model/draft.hpp"

namespace eigentrail {

/// Adds the nodes of all [[beam]] tables to the bodies, with their masses and the constraints that hold the
/// ends, and the quadrature points to the beams. Bodies must have been read.
void read_beams(Draft& draft);

/// Adds the elements of all beams.
void add_beam_sections(Draft& draft);

/// Adds the damping of all beams at their quadrature points: that of their own, and of [[beam_damping]]
/// tables.
void read_beam_damping(Draft& draft);

/// Times must not be negative. One of several, which enter by their roots, must not become zero on the trace.
void check_time(Draft& draft, const TableReader& table, const std::string& key, const Expression& time,
                bool has_root);

/// Keys of both tables.
std::vector<FieldHelp> beam_fields();
std::vector<FieldHelp> beam_damping_fields();

}  // namespace eigentrail
