// Writes a record while a force is called with Recorded scalars.
#pragma once

#include <unordered_map>
#include <vector>

#include "model/record/record.hpp"
#include "model/record/recorded.hpp"

namespace eigentrail {

/// Equal operations are recorded once. Must outlive the scalars that it gives.
class Recorder {
 public:
  Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A number of the model by its slot. Numbers are inputs in the order of their first use.
  Recorded number(int slot) { return input(Operator::number, numbers_, slot, record_.n_numbers); }
  /// A constant that is an operation: computed with the precision of each evaluation.
  Recorded constant(double value) { return push({Operator::constant, -1, -1, value}); }
  /// A coordinate of the model by its index, likewise.
  Recorded coordinate(int index);
  /// A new component, sum of weight * coordinate.
  Recorded component(const std::vector<std::pair<int, Recorded>>& shares);
  Recorded rate(int component) { return push({Operator::rate, -1, component}); }
  Recorded acceleration(int component) { return push({Operator::acceleration, -1, component}); }
  Recorded apply(const SmoothFunction& f, const Recorded& x);

  Recorded operation(Operator op, const Recorded& a) { return push({op, node(a)}); }
  Recorded operation(Operator op, const Recorded& a, const Recorded& b) {
    return push({op, node(a), node(b)});
  }

  /// The operation that is a value; literals become constants.
  int node(const Recorded& value);

  int n_components() const { return static_cast<int>(record_.components.size()); }

  /// The record, for the caller to set its outputs; and what its inputs are in the model.
  Record& record() { return record_; }
  const std::vector<int>& numbers() const { return numbers_.all; }
  const std::vector<int>& coordinates() const { return coordinates_.all; }
  const std::vector<const SmoothFunction*>& functions() const { return functions_; }

 private:
  struct Hash {
    std::size_t operator()(const Operation& operation) const;
  };

  /// Inputs of one kind: what they are in the model, and their indices by that.
  struct Inputs {
    std::vector<int> all;
    std::unordered_map<int, int> index;
  };

  Recorded push(Operation operation);
  Recorded input(Operator op, Inputs& inputs, int of_model, int& count);

  Record record_;
  std::unordered_map<Operation, int, Hash> known_;
  Inputs numbers_, coordinates_;
  std::vector<const SmoothFunction*> functions_;
};

}  // namespace eigentrail
