#include "model/record/slots.hpp"

#include <algorithm>

namespace eigentrail {
namespace {

/// Calls visit(register) for all operands.
void for_each_operand(auto& instruction, auto visit) {
  visit(instruction.a);
  if (instruction.op != Operator::function) visit(instruction.b);
  visit(instruction.c);
  visit(instruction.d);
}

/// Calls visit(register) for everything that is wanted in the end.
void for_each_output(Program& program, auto visit) {
  for (LocalValue& force : program.forces) visit(force.slot);
  for (LocalValue& value : program.values) visit(value.slot);
  for (Entry& entry : program.entries) visit(entry.slot);
  visit(program.residual);
}

/// Gives registers slots, one after the last use of another: what is computed stays in the cache.
class SlotAssignment {
 public:
  SlotAssignment(Program& program, int n_registers)
      : program_(program),
        last_use_(static_cast<std::size_t>(n_registers), -1),
        slots_(last_use_.size(), -1) {}

  void run() {
    const int end = static_cast<int>(program_.instructions.size());
    const auto use = [&](int reg, int when) {
      if (reg >= 0) last_use_[static_cast<std::size_t>(reg)] = when;
    };
    for (int i = 0; i < end; ++i)
      for_each_operand(program_.instructions[static_cast<std::size_t>(i)], [&](int reg) { use(reg, i); });
    for (Instruction& constant : program_.constants) use(constant.out, end);
    for_each_output(program_, [&](int reg) { use(reg, end); });
    for (Instruction& constant : program_.constants) define(constant.out);
    for (auto* inputs : {&program_.numbers, &program_.coordinates}) {
      for (LocalValue& input : *inputs) define(input.slot);
    }
    for (int i = 0; i < end; ++i) assign(program_.instructions[static_cast<std::size_t>(i)], i);
    for_each_output(program_, [&](int& reg) { replace(reg); });
    program_.n_slots = n_slots_;
  }

 private:
  /// A result has no slot of an operand: kernels of series read these while they write.
  void assign(Instruction& instruction, int i) {
    std::vector<int> done;
    for_each_operand(instruction, [&](int& reg) {
      if (reg >= 0 && last_use_[static_cast<std::size_t>(reg)] == i) done.push_back(reg);
      replace(reg);
    });
    std::sort(done.begin(), done.end());
    done.erase(std::unique(done.begin(), done.end()), done.end());
    const int results[2] = {instruction.out, instruction.second};
    define(instruction.out);
    if (instruction.second >= 0) define(instruction.second);
    for (const int reg : done) free_.push_back(slots_[static_cast<std::size_t>(reg)]);
    for (const int reg : results) {
      if (reg >= 0 && last_use_[static_cast<std::size_t>(reg)] < 0)
        free_.push_back(slots_[static_cast<std::size_t>(reg)]);
    }
  }

  void define(int& reg) {
    int slot = n_slots_;
    if (free_.empty()) {
      ++n_slots_;
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_[static_cast<std::size_t>(reg)] = slot;
    reg = slot;
  }
  void replace(int& reg) const {
    if (reg >= 0) reg = slots_[static_cast<std::size_t>(reg)];
  }

  Program& program_;
  std::vector<int> last_use_;
  std::vector<int> slots_;
  std::vector<int> free_;
  int n_slots_ = 0;
};

}  // namespace

void assign_slots(Program& program, int n_registers) {
  SlotAssignment(program, n_registers).run();
}

void Inputs::add(const Inputs& other) {
  numbers.insert(other.numbers.begin(), other.numbers.end());
  coordinates = coordinates || other.coordinates;
}

std::vector<Inputs> inputs_by_slot(const Program& program) {
  std::vector<Inputs> slots(static_cast<std::size_t>(program.n_slots));
  const auto at = [&slots](int slot) -> Inputs& { return slots[static_cast<std::size_t>(slot)]; };
  for (const LocalValue& number : program.numbers) at(number.slot).numbers = {number.index};
  for (const LocalValue& coordinate : program.coordinates) at(coordinate.slot).coordinates = true;
  for (const Instruction& instruction : program.instructions) {
    Inputs inputs;
    for_each_operand(instruction, [&](int slot) {
      if (slot >= 0) inputs.add(at(slot));
    });
    if (instruction.second >= 0) at(instruction.second) = inputs;
    at(instruction.out) = std::move(inputs);
  }
  return slots;
}

}  // namespace eigentrail
