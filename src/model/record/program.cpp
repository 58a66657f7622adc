#include "model/record/program.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <stdexcept>

#include "model/record/slots.hpp"

namespace eigentrail {
namespace {

/// A direction of differentiation: component + (number of components) * (0 value, 1 rate, 2 acceleration).
using Directions = std::vector<int>;

Directions united(const Directions& a, const Directions& b) {
  Directions both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

/// Emits instructions for the values and derivatives that are asked for. Results are in registers, each
/// written once; slots are assigned afterwards.
class Compiler {
 public:
  explicit Compiler(const Record& record)
      : record_(record),
        zero_(record.operations.size()),
        active_(record.operations.size()),
        values_(record.operations.size(), -1) {
    for (std::size_t i = 0; i < record.operations.size(); ++i) look_at(i);
    one_ = constant(1.0);
    minus_one_ = constant(-1.0);
  }

  void add_forces() {
    for (std::size_t i = 0; i < record_.forces.size(); ++i) {
      if (record_.forces[i] < 0 || zero_[at(record_.forces[i])]) continue;
      const int force = strong(value(record_.forces[i]));
      for (const Share& share : record_.components[i])
        program_.forces.push_back({share.coordinate, product(weight(share), force)});
    }
    if (record_.residual >= 0) program_.residual = value(record_.residual);
    for (std::size_t i = 0; i < record_.values.size(); ++i)
      program_.values.push_back({static_cast<int>(i), value(record_.values[i])});
  }

  /// For every target: columns by components first, then by coordinates.
  void add_entries() {
    const int n = static_cast<int>(record_.components.size());
    for (const auto& [motion, target] :
         {std::pair(2, Target::mass), std::pair(1, Target::damping), std::pair(0, Target::stiffness)}) {
      Sums<std::pair<int, int>> sums;
      for (int component = 0; component < n; ++component) {
        Sums<int> column;
        for (int i = 0; i < static_cast<int>(record_.forces.size()); ++i) {
          const int force = record_.forces[at(i)];
          if (force < 0 || !depends(force, motion * n + component)) continue;
          add_shares(i, strong(tangent(force, motion * n + component)), column);
        }
        for (const auto& [row, reg] : column) spread(row, component, reg, sums);
      }
      take(sums, target);
    }
    if (record_.residual < 0) return;
    Sums<std::pair<int, int>> gradient;
    for (int component = 0; component < n; ++component) {
      if (depends(record_.residual, component))
        spread(0, component, tangent(record_.residual, component), gradient);
    }
    take(gradient, Target::constraints);
  }

  Program finish() {
    program_.n_directions = static_cast<int>(directions_.size());
    assign_slots(program_, next_);
    return std::move(program_);
  }

 private:
  /// Registers by place. What needs no product is not added here, but where elements are.
  template <class Key>
  using Sums = std::multimap<Key, int>;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Operation& operation(int node) const { return record_.operations[at(node)]; }

  /// Whether the value of an operation is zero at the steady state, and the directions on which it depends.
  void look_at(std::size_t i) {
    const Operation& own = record_.operations[i];
    const int n = static_cast<int>(record_.components.size());
    const auto zero = [&](int node) { return bool(zero_[at(node)]); };
    switch (own.op) {
      case Operator::component:
        active_[i] = {own.b};
        return;
      case Operator::rate:
      case Operator::acceleration:
        active_[i] = {(own.op == Operator::rate ? n : 2 * n) + own.b};
        zero_[i] = true;
        return;
      case Operator::add:
      case Operator::subtract:
        zero_[i] = zero(own.a) && zero(own.b);
        active_[i] = united(active_[at(own.a)], active_[at(own.b)]);
        return;
      case Operator::multiply:
        zero_[i] = zero(own.a) || zero(own.b);
        active_[i] = united(zero(own.b) ? Directions() : active_[at(own.a)],
                            zero(own.a) ? Directions() : active_[at(own.b)]);
        return;
      case Operator::divide:
        zero_[i] = zero(own.a);
        active_[i] = united(active_[at(own.a)], zero(own.a) ? Directions() : active_[at(own.b)]);
        return;
      case Operator::negate:
        zero_[i] = zero(own.a);
        active_[i] = active_[at(own.a)];
        return;
      case Operator::power:
      case Operator::min:
      case Operator::max:
        active_[i] = united(active_[at(own.a)], active_[at(own.b)]);
        return;
      case Operator::constant:
      case Operator::number:
      case Operator::coordinate:
      case Operator::step:
      case Operator::leading_angle:
        return;
      default:
        active_[i] = active_[at(own.a)];
    }
  }

  bool depends(int node, int direction) const {
    const Directions& all = active_[at(node)];
    return std::binary_search(all.begin(), all.end(), direction);
  }

  int emit(Operator op, int a = -1, int b = -1, int c = -1, int d = -1) {
    program_.instructions.push_back({op, next_, a, b, c, d});
    return next_++;
  }

  int constant(double value) {
    const auto [known, is_new] = constants_.emplace(std::bit_cast<std::uint64_t>(value), next_);
    if (is_new) program_.constants.push_back({Operator::constant, next_++, -1, -1, -1, -1, -1, value});
    return known->second;
  }

  int product(int a, int b) {
    if (a == one_) return b;
    if (b == one_) return a;
    if (a == minus_one_) return negated(b);
    if (b == minus_one_) return negated(a);
    return emit(Operator::multiply, a, b);
  }
  int negated(int a) {
    if (a == one_) return minus_one_;
    return a == minus_one_ ? one_ : emit(Operator::negate, a);
  }
  int sum(int a, int b) { return emit(Operator::add, a, b); }
  /// a b + c
  int product_and(int a, int b, int c) {
    if (a == one_) return sum(b, c);
    return b == one_ ? sum(a, c) : emit(Operator::multiply_add, a, b, c);
  }

  int strong(int force) { return record_.strength < 0 ? force : product(value(record_.strength), force); }

  int weight(const Share& share) { return share.weight < 0 ? one_ : value(share.weight); }

  /// Adds what a component with `reg` gives to its coordinates: to rows, or to the columns of a row.
  void add_shares(int component, int reg, Sums<int>& sums) {
    for (const Share& share : record_.components[at(component)])
      add(sums, share.coordinate, weight(share), reg);
  }
  void spread(int row, int component, int reg, Sums<std::pair<int, int>>& sums) {
    for (const Share& share : record_.components[at(component)])
      add(sums, std::pair(row, share.coordinate), weight(share), reg);
  }
  template <class Key>
  void add(Sums<Key>& sums, const Key& key, int factor, int reg) {
    const auto known = sums.find(key);
    if (known == sums.end() || factor == one_)
      sums.emplace(key, product(factor, reg));
    else
      known->second = product_and(factor, reg, known->second);
  }

  void take(const Sums<std::pair<int, int>>& sums, Target target) {
    for (const auto& [place, reg] : sums)
      program_.entries.push_back({target, place.first, place.second, reg});
  }

  int value(int node) {
    int& reg = values_[at(node)];
    if (reg < 0) reg = new_value(node);
    return reg;
  }

  /// The first or second result of an instruction that has two.
  int both(Operator op, int of, bool second) {
    const auto known = pairs_.find({op, of});
    if (known != pairs_.end()) return known->second + int{second};
    const int first = emit(op, value(of));
    program_.instructions.back().second = next_++;
    pairs_[{op, of}] = first;
    return first + int{second};
  }

  int new_value(int node) {
    const Operation& own = operation(node);
    if (zero_[at(node)]) return constant(0.0);
    switch (own.op) {
      case Operator::constant:
        return constant(own.constant);
      case Operator::number:
        program_.numbers.push_back({own.a, next_});
        return next_++;
      case Operator::coordinate:
        program_.coordinates.push_back({own.a, next_});
        return next_++;
      case Operator::component:
        return value(own.a);
      case Operator::negate:
        return negated(value(own.a));
      case Operator::sin:
      case Operator::cos:
        return both(Operator::sin, own.a, own.op == Operator::cos);
      case Operator::sinh:
      case Operator::cosh:
        return both(Operator::sinh, own.a, own.op == Operator::cosh);
      case Operator::log:
      case Operator::asin:
      case Operator::acos:
      case Operator::atan: {
        const int rate = slope(node);
        return emit(own.op, value(own.a), rate);
      }
      case Operator::function: {
        const int reg = emit(own.op, value(own.a), own.b);
        program_.instructions.back().second = slopes_[node] = next_++;
        return reg;
      }
      default:
        if (own.op == Operator::add || own.op == Operator::subtract) {
          if (zero_[at(own.b)]) return value(own.a);
          if (zero_[at(own.a)]) return own.op == Operator::add ? value(own.b) : negated(value(own.b));
        }
        const int left = value(own.a);
        return emit(own.op, left, own.b < 0 ? -1 : value(own.b));
    }
  }

  /// Derivative of a function of one argument, as a value.
  int slope(int node) {
    const auto known = slopes_.find(node);
    if (known != slopes_.end()) return known->second;
    const int reg = new_slope(node);
    return slopes_[node] = reg;
  }

  int new_slope(int node) {
    const Operation& own = operation(node);
    switch (own.op) {
      case Operator::exp:
        return value(node);
      case Operator::log:
        return emit(Operator::divide, one_, value(own.a));
      case Operator::sin:
        return both(Operator::sin, own.a, true);
      case Operator::sinh:
        return both(Operator::sinh, own.a, true);
      case Operator::cosh:
        return both(Operator::sinh, own.a, false);
      case Operator::tanh:
        return emit(Operator::multiply_behind, value(node), value(node), one_);
      case Operator::atan: {
        const int x = value(own.a);
        return emit(Operator::divide, one_, emit(Operator::multiply_add, x, x, one_));
      }
      case Operator::asin:
      case Operator::acos: {
        const int x = value(own.a);
        const int root = emit(Operator::sqrt, emit(Operator::multiply_behind, x, x, one_));
        return emit(Operator::divide, own.op == Operator::asin ? one_ : minus_one_, root);
      }
      case Operator::function:
        value(node);
        return slopes_.at(node);
      default:
        throw std::logic_error("Compiler: a function without derivative");
    }
  }

  int tangent(int node, int direction) {
    const std::pair key(node, direction);
    const auto known = tangents_.find(key);
    if (known != tangents_.end()) return known->second;
    const int reg = new_tangent(node, direction);
    tangents_[key] = reg;
    return reg;
  }

  int new_tangent(int node, int direction) {
    const Operation& own = operation(node);
    switch (own.op) {
      case Operator::component:
      case Operator::rate:
      case Operator::acceleration:
        directions_.insert(direction);
        return one_;
      case Operator::add: {
        if (!depends(own.a, direction)) return tangent(own.b, direction);
        const int a = tangent(own.a, direction);
        return depends(own.b, direction) ? sum(a, tangent(own.b, direction)) : a;
      }
      case Operator::subtract: {
        if (!depends(own.a, direction)) return negated(tangent(own.b, direction));
        const int a = tangent(own.a, direction);
        return depends(own.b, direction) ? emit(Operator::subtract, a, tangent(own.b, direction)) : a;
      }
      case Operator::negate:
        return negated(tangent(own.a, direction));
      case Operator::multiply:
        return product_tangent(own, direction);
      case Operator::divide:
        return quotient_tangent(node, own, direction);
      case Operator::sqrt: {
        const auto known = slopes_.find(node);
        const int twice = known != slopes_.end() ? known->second : product(constant(2.0), value(node));
        slopes_[node] = twice;
        return emit(Operator::divide, tangent(own.a, direction), twice);
      }
      case Operator::cos: {
        const int sine = both(Operator::sin, own.a, false);
        return negated(product(tangent(own.a, direction), sine));
      }
      case Operator::power:
        return power_tangent(own, direction);
      case Operator::min:
      case Operator::max:
        return choice_tangent(own, direction);
      default: {
        const int rate = slope(node);
        return product(tangent(own.a, direction), rate);
      }
    }
  }

  int product_tangent(const Operation& own, int direction) {
    const bool by_a = depends(own.a, direction) && !zero_[at(own.b)];
    const bool by_b = depends(own.b, direction) && !zero_[at(own.a)];
    if (!by_a) return product(value(own.a), tangent(own.b, direction));
    if (!by_b) return product(tangent(own.a, direction), value(own.b));
    const int a = tangent(own.a, direction), b = tangent(own.b, direction);
    const int left = value(own.a), right = value(own.b);
    if (a == one_ || b == one_) return product_and(left, b, product(a, right));
    return emit(Operator::multiply_two, left, b, a, right);
  }

  /// (a / b)' = (a' - (a / b) b') / b
  int quotient_tangent(int node, const Operation& own, int direction) {
    const bool by_b = depends(own.b, direction) && !zero_[at(own.a)];
    int rest = depends(own.a, direction) ? tangent(own.a, direction) : -1;
    if (by_b) {
      const int quotient = value(node), b = tangent(own.b, direction);
      rest = rest < 0 ? negated(product(quotient, b)) : emit(Operator::multiply_behind, quotient, b, rest);
    }
    return emit(Operator::divide, rest, value(own.b));
  }

  /// (x^y)' = y x^(y - 1) x' + x^y log(x) y'
  int power_tangent(const Operation& own, int direction) {
    const int x = value(own.a), y = value(own.b);
    int result = -1;
    if (depends(own.a, direction)) {
      const int lower = emit(Operator::power, x, emit(Operator::subtract, y, one_));
      result = product(tangent(own.a, direction), product(y, lower));
    }
    if (!depends(own.b, direction)) return result;
    const int logarithm = emit(Operator::log, x, emit(Operator::divide, one_, x));
    const int by_y = product(tangent(own.b, direction), product(emit(Operator::power, x, y), logarithm));
    return result < 0 ? by_y : sum(result, by_y);
  }

  int choice_tangent(const Operation& own, int direction) {
    const auto side = [&](int node) {
      return depends(node, direction) ? tangent(node, direction) : constant(0.0);
    };
    const int a = side(own.a), b = side(own.b);
    const Operator op = own.op == Operator::min ? Operator::choose_min : Operator::choose_max;
    return emit(op, value(own.a), value(own.b), a, b);
  }

  const Record& record_;
  std::vector<char> zero_;
  std::vector<Directions> active_;
  std::vector<int> values_;                        ///< registers of the values by operation
  std::map<std::pair<int, int>, int> tangents_;    ///< by operation and direction
  std::map<int, int> slopes_;                      ///< derivatives of functions, by operation
  std::map<std::pair<Operator, int>, int> pairs_;  ///< first results of instructions with two
  std::map<std::uint64_t, int> constants_;         ///< registers by the bits of the number
  std::set<int> directions_;
  Program program_;
  int next_ = 0;
  int one_ = -1, minus_one_ = -1;
};

}  // namespace

Program value_program(const Record& record) {
  Compiler compiler(record);
  compiler.add_forces();
  return compiler.finish();
}

Program derivative_program(const Record& record) {
  Compiler compiler(record);
  compiler.add_entries();
  return compiler.finish();
}

}  // namespace eigentrail
