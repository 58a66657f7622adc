// Where the results of a program are kept.
#pragma once

#include "model/record/program.hpp"

namespace eigentrail {

/// Replaces the registers of a program, each of which is written once, by slots that are used again. Sets
/// `n_slots`.
void assign_slots(Program& program, int n_registers);

}  // namespace eigentrail
