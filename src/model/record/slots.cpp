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

constexpr int never_used = -1;

/// The instruction that uses a register last, by register; the number of instructions for what is wanted in
/// the end.
std::vector<int> last_uses(Program& program, int n_registers) {
  std::vector<int> last_use(static_cast<std::size_t>(n_registers), never_used);
  int now = 0;
  const auto use = [&](int reg) {
    if (reg >= 0) last_use[static_cast<std::size_t>(reg)] = now;
  };
  for (; now < static_cast<int>(program.instructions.size()); ++now)
    for_each_operand(program.instructions[static_cast<std::size_t>(now)], use);
  for (const Instruction& constant : program.constants) use(constant.out);
  for_each_output(program, use);
  return last_use;
}

}  // namespace

/// A slot is free again after the last use of its register: what is computed stays in the cache. A result has
/// no slot of an operand: kernels of series read these while they write.
void assign_slots(Program& program, int n_registers) {
  const int end = static_cast<int>(program.instructions.size());
  std::vector<int> last_use = last_uses(program, n_registers), slots = last_use, free;
  const auto last = [&](int reg) -> int& { return last_use[static_cast<std::size_t>(reg)]; };
  const auto slot = [&](int reg) -> int& { return slots[static_cast<std::size_t>(reg)]; };
  const auto replace = [&](int& reg) { reg = reg < 0 ? reg : slot(reg); };
  const auto define = [&](int& reg) {
    if (free.empty()) free.push_back(program.n_slots++);
    slot(reg) = free.back();
    free.pop_back();
    reg = slot(reg);
  };
  for (Instruction& constant : program.constants) define(constant.out);
  for (auto* inputs : {&program.numbers, &program.coordinates}) {
    for (LocalValue& input : *inputs) define(input.slot);
  }
  for (int i = 0; i < end; ++i) {
    Instruction& instruction = program.instructions[static_cast<std::size_t>(i)];
    std::vector<int> done;
    const auto end_at = [&](int reg, int when) {
      if (reg < 0 || last(reg) != when) return;
      last(reg) = end;
      done.push_back(reg);
    };
    for_each_operand(instruction, [&](int reg) { end_at(reg, i); });
    for_each_operand(instruction, replace);
    for (int* result : {&instruction.out, &instruction.second}) {
      if (*result < 0) continue;
      end_at(*result, never_used);
      define(*result);
    }
    for (const int reg : done) free.push_back(slot(reg));
  }
  for_each_output(program, replace);
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
