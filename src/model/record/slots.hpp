// Where the results of a program are kept, and what they depend on.
#pragma once

#include <set>

#include "model/record/program.hpp"

namespace eigentrail {

/// Replaces the registers of a program, each of which is written once, by slots that are used again. Sets
/// `n_slots`.
void assign_slots(Program& program, int n_registers);

/// On what a result depends: numbers by local index, and whether on coordinates.
struct Inputs {
  std::set<int> numbers;
  bool coordinates = false;

  void add(const Inputs& other);
};

/// The inputs of what the slots of a program hold in the end, its results among it.
std::vector<Inputs> inputs_by_slot(const Program& program);

}  // namespace eigentrail
