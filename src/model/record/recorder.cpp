#include "model/record/recorder.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace eigentrail {

std::size_t Recorder::Hash::operator()(const Operation& operation) const {
  std::uint64_t hash = static_cast<std::uint64_t>(operation.op);
  for (const std::uint64_t part : {static_cast<std::uint64_t>(static_cast<std::uint32_t>(operation.a)),
                                   static_cast<std::uint64_t>(static_cast<std::uint32_t>(operation.b)),
                                   std::bit_cast<std::uint64_t>(operation.constant)}) {
    hash = (hash ^ part) * 0x9e3779b97f4a7c15U;  // golden ratio, as in Fibonacci hashing
    hash ^= hash >> 29;
  }
  return hash;
}

Recorded Recorder::push(Operation operation) {
  const auto [at, is_new] = known_.emplace(operation, static_cast<int>(record_.operations.size()));
  if (is_new) record_.operations.push_back(operation);
  return {*this, at->second};
}

int Recorder::node(const Recorded& value) {
  if (value.recorder() == nullptr) return push({Operator::constant, -1, -1, value.literal()}).node();
  if (value.recorder() != this) throw std::logic_error("Recorder: a value of another recorder");
  return value.node();
}

Recorded Recorder::input(Operator op, Inputs& inputs, int of_model, int& count) {
  const auto [at, is_new] = inputs.index.emplace(of_model, count);
  if (is_new) {
    inputs.all.push_back(of_model);
    ++count;
  }
  return push({op, at->second});
}

Recorded Recorder::coordinate(int index) {
  return input(Operator::coordinate, coordinates_, index, record_.n_coordinates);
}

Recorded Recorder::component(const std::vector<std::pair<int, Recorded>>& shares) {
  Recorded value;
  std::vector<Share> own;
  for (const auto& [index, weight] : shares) {
    const Recorded x = coordinate(index);
    value += weight * x;
    own.push_back({record_.operations[static_cast<std::size_t>(x.node())].a,
                   weight.is_literal(1.0) ? -1 : node(weight)});
  }
  record_.components.push_back(std::move(own));
  return push({Operator::component, node(value), n_components() - 1});
}

Recorded Recorder::apply(const SmoothFunction& f, const Recorded& x) {
  auto at = std::find(functions_.begin(), functions_.end(), &f);
  if (at == functions_.end()) {
    functions_.push_back(&f);
    ++record_.n_functions;
    at = functions_.end() - 1;
  }
  return push({Operator::function, node(x), static_cast<int>(at - functions_.begin())});
}

Recorded Recorded::of(Operator op, const Recorded& x) {
  if (x.recorder() == nullptr) throw std::logic_error("Recorded: a function of a literal");
  return x.recorder()->operation(op, x);
}

Recorded Recorded::of(Operator op, const Recorded& a, const Recorded& b) {
  Recorder* const recorder = recorder_of(a, b);
  if (recorder == nullptr) throw std::logic_error("Recorded: a function of literals");
  return recorder->operation(op, a, b);
}

Recorded angle_of(const Recorded& sine, const Recorded& cosine) {
  const Recorded turn = Recorded::of(Operator::leading_angle, sine, cosine);
  const Recorded c = cos(turn);
  const Recorded s = sin(turn);
  return turn + atan((sine * c - cosine * s) / (cosine * c + sine * s));
}

Recorded apply(const SmoothFunction& f, const Recorded& x) {
  if (x.recorder() == nullptr) throw std::logic_error("a function of a literal");
  return x.recorder()->apply(f, x);
}

}  // namespace eigentrail
