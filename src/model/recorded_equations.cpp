#include "model/recorded_equations.hpp"

#include <algorithm>

#include "model/record/recorder.hpp"

namespace eigentrail {

int Pattern::position(int at_row, int at_column) const {
  if (!is_sparse()) return at_column * rows + at_row;
  const auto begin = row.begin() + first[static_cast<std::size_t>(at_column)];
  const auto end = row.begin() + first[static_cast<std::size_t>(at_column) + 1];
  return static_cast<int>(std::lower_bound(begin, end, at_row) - row.begin());
}

namespace {

/// Records one element or one row of a constraint.
class ElementRecorder {
 public:
  explicit ElementRecorder(const MultibodyData& data) : data_(data) {}

  using View = ElementView<Recorded>;

  /// The moving vectors and states, as components in this order.
  View view(const std::vector<Place>& arguments, int first_state, int n_states) {
    std::vector<MovingVector<Recorded>> vectors(arguments.size());
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<std::pair<int, Recorded>> shares;
        for (const Term& term : arguments[i].terms)
          shares.emplace_back(3 * term.triple + axis,
                              term.weight.slot < 0 ? Recorded(1.0) : recorder_.number(term.weight.slot));
        vectors[i].position[axis] = recorder_.component(shares);
        vectors[i].velocity[axis] = recorder_.rate(recorder_.n_components() - 1);
        vectors[i].acceleration[axis] = recorder_.acceleration(recorder_.n_components() - 1);
      }
    }
    std::vector<MovingState<Recorded>> states;
    for (int i = 0; i < n_states; ++i) {
      const Recorded value = recorder_.component({{3 * data_.n_triples + first_state + i, Recorded(1.0)}});
      states.push_back({value, recorder_.rate(recorder_.n_components() - 1)});
    }
    return View([this](int slot) { return recorder_.number(slot); }, std::move(vectors), std::move(states));
  }

  Recorded multiplier(int row) { return recorder_.number(static_cast<int>(data_.quantities.size()) + row); }

  void set_forces(const View& view) {
    const auto add = [&](const Recorded& force) {
      recorder_.record().forces.push_back(force.is_literal(0.0) ? -1 : recorder_.node(force));
    };
    for (const MovingVector<Recorded>& vector : view.vectors()) {
      for (int axis = 0; axis < 3; ++axis) add(vector.force[axis]);
    }
    for (const MovingState<Recorded>& state : view.states()) add(state.force);
  }
  void set_strength(const Quantity& strength) {
    if (strength.slot >= 0) recorder_.record().strength = recorder_.node(recorder_.number(strength.slot));
  }
  void set_residual(const Recorded& residual) { recorder_.record().residual = recorder_.node(residual); }

  Recorder& recorder() { return recorder_; }

 private:
  const MultibodyData& data_;
  Recorder recorder_;
};

/// Collects records into batches: elements of one kind with equal records are one.
class BatchCollector {
 public:
  explicit BatchCollector(const MultibodyData& data) {
    equations_.n = data.n_coordinates;
    equations_.m = data.n_constraints;
    equations_.counts.assign(Elements::kinds, 0);
  }

  /// A name for messages; it is that of what is added next.
  void begin(std::size_t kind, const std::string& label) {
    kind_ = kind;
    equations_.labels.push_back(label);
    if (kind >= equations_.counts.size()) equations_.counts.resize(kind + 1, 0);
    ++equations_.counts[kind];
  }

  /// `row`: of its residual; -1: it has none.
  void add(Recorder& recorder, int row) {
    Batch& batch = batch_of(recorder.record());
    ++batch.size;
    const auto append = [](auto& all, const auto& own) { all.insert(all.end(), own.begin(), own.end()); };
    append(batch.numbers, recorder.numbers());
    append(batch.coordinates, recorder.coordinates());
    append(batch.functions, recorder.functions());
    if (row >= 0) batch.rows.push_back(row);
    batch.labels.push_back(static_cast<int>(equations_.labels.size()) - 1);
  }

  RecordedEquations finish() {
    for (std::size_t target = 0; target < equations_.patterns.size(); ++target)
      equations_.patterns[target] = pattern(static_cast<Target>(target));
    for (Batch& batch : equations_.batches) {
      for_each_entry(batch, [&](const Entry& entry, int row, int column) {
        batch.positions.push_back(
            equations_.patterns[static_cast<std::size_t>(entry.target)].position(row, column));
      });
      note_inputs(batch);
    }
    return std::move(equations_);
  }

 private:
  Batch& batch_of(const Record& record) {
    for (Batch& batch : equations_.batches) {
      if (batch.kind == kind_ && batch.record == record) return batch;
    }
    Batch& batch = equations_.batches.emplace_back();
    batch.kind = kind_;
    batch.record = record;
    batch.values = value_program(record);
    batch.derivatives = derivative_program(record);
    return batch;
  }

  /// Adds to the inputs of the equations those of a batch.
  void note_inputs(const Batch& batch) {
    std::array<Inputs, 4> of_matrices;
    Inputs of_residual;
    const std::vector<Inputs> derivatives = inputs_by_slot(batch.derivatives);
    for (const Entry& entry : batch.derivatives.entries)
      of_matrices[static_cast<std::size_t>(entry.target)].add(
          derivatives[static_cast<std::size_t>(entry.slot)]);
    const std::vector<Inputs> values = inputs_by_slot(batch.values);
    for (const LocalValue& force : batch.values.forces)
      of_residual.add(values[static_cast<std::size_t>(force.slot)]);
    if (batch.values.residual >= 0) of_residual.add(values[static_cast<std::size_t>(batch.values.residual)]);
    const auto add = [&batch](Inputs& sum, const Inputs& local) {
      sum.coordinates = sum.coordinates || local.coordinates;
      for (std::size_t element = 0; element < batch.size; ++element) {
        for (const int number : local.numbers)
          sum.numbers.insert(batch.numbers[element * static_cast<std::size_t>(batch.record.n_numbers) +
                                           static_cast<std::size_t>(number)]);
      }
    };
    for (std::size_t target = 0; target < of_matrices.size(); ++target)
      add(equations_.inputs[target], of_matrices[target]);
    add(equations_.inputs_of_residual, of_residual);
  }

  /// Calls visit(entry, row, column) for the entries of all elements of a batch.
  static void for_each_entry(const Batch& batch, auto visit) {
    const auto n = static_cast<std::size_t>(batch.record.n_coordinates);
    for (std::size_t element = 0; element < batch.size; ++element) {
      const auto coordinate = [&](int i) {
        return batch.coordinates[element * n + static_cast<std::size_t>(i)];
      };
      for (const Entry& entry : batch.derivatives.entries) {
        const bool of_residual = entry.target == Target::constraints;
        visit(entry, of_residual ? batch.rows[element] : coordinate(entry.row), coordinate(entry.column));
      }
    }
  }

  Pattern pattern(Target target) const {
    Pattern result{target == Target::constraints ? equations_.m : equations_.n, equations_.n, {}, {}};
    if (equations_.n < sparse_from) return result;
    std::vector<std::pair<int, int>> places;  // column, row
    for (const Batch& batch : equations_.batches) {
      for_each_entry(batch, [&](const Entry& entry, int row, int column) {
        if (entry.target == target) places.emplace_back(column, row);
      });
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    result.first.assign(static_cast<std::size_t>(equations_.n) + 1, 0);
    for (const auto& [column, row] : places) {
      ++result.first[static_cast<std::size_t>(column) + 1];
      result.row.push_back(row);
    }
    for (std::size_t i = 1; i < result.first.size(); ++i) result.first[i] += result.first[i - 1];
    return result;
  }

  RecordedEquations equations_;
  std::size_t kind_ = 0;
};

/// The product or the component that a row is, less its offset. Its forces are -lambda times its gradient, so
/// their derivatives are those of A^T lambda.
Recorded record_product(ElementView<Recorded>& at, const ConstraintRow& row, const Recorded& lambda) {
  const auto value = [&](const Difference& side) -> Vec3<Recorded> {
    const Vec3<Recorded> first = at.position(side.first);
    return side.second ? Vec3<Recorded>(first - at.position(*side.second)) : first;
  };
  const auto add = [&](const Difference& side, const Vec3<Recorded>& gradient) {
    const Vec3<Recorded> force = lambda * gradient;
    at.add_force(side.first, -force);
    if (side.second) at.add_force(*side.second, force);
  };
  const Vec3<Recorded> a = value(row.a);
  const Recorded offset = at.value(row.offset);
  if (!row.b) {
    add(row.a, Vec3<Recorded>::Unit(row.axis));
    return a[row.axis] - offset;
  }
  const Vec3<Recorded> b = value(*row.b);
  add(row.a, b);
  add(*row.b, a);
  return a.dot(b) - offset;
}

/// The same of coupled motions.
Recorded record_coupling(ElementView<Recorded>& at, const ConstraintRow& row, const Recorded& lambda) {
  Recorded sum = -at.value(row.offset);
  for (const CoupledMotion& motion : row.coupled) {
    const Recorded ratio = at.value(motion.ratio), force = -lambda * ratio;
    const HingeAngle& joint = motion.joint;
    if (motion.slides) {
      const Vec3<Recorded> axis = at.position(joint.axis);
      const Vec3<Recorded> d = at.position(joint.to) - at.position(joint.from);
      at.add_force(joint.axis, force * d);
      at.add_force(joint.to, force * axis);
      at.add_force(joint.from, -force * axis);
      sum = sum + ratio * axis.dot(d);
    } else {
      const detail::AngleAt<Recorded> theta(at, joint);
      theta.add_moment(at, joint, force);
      sum = sum + ratio * angle_of(theta.sine, theta.cosine);
    }
  }
  return sum;
}

/// Records a row with this index; the result has its forces.
ElementView<Recorded> record_row(ElementRecorder& recorder, const ConstraintRow& row, int index) {
  ConstraintRow own = row;
  std::vector<Place> arguments;
  ConstraintRow::for_each_place(own, [&](Place& place) {
    if (!place.moves()) return;
    place.argument = static_cast<int>(arguments.size());
    arguments.push_back(place);
  });
  ElementView<Recorded> at = recorder.view(arguments, 0, 0);
  const Recorded lambda = recorder.multiplier(index);
  recorder.set_residual(own.coupled.empty() ? record_product(at, own, lambda)
                                            : record_coupling(at, own, lambda));
  return at;
}

}  // namespace

RecordedEquations record_equations(const MultibodyData& data, const Elements& elements,
                                   const std::vector<Constraint>& constraints) {
  BatchCollector collector(data);
  elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t kind) {
    for (const Placed<Element>& placed : list) {
      ElementRecorder recorder(data);
      collector.begin(kind, placed.label);
      ElementView<Recorded> view =
          recorder.view(placed.arguments, placed.first_state, number_of_states<Element>());
      placed.element.force(view);
      recorder.set_forces(view);
      recorder.set_strength(placed.strength);
      collector.add(recorder.recorder(), -1);
    }
  });
  for (const Constraint& constraint : constraints) {
    collector.begin(Elements::kinds + static_cast<std::size_t>(constraint.kind), constraint.label);
    int index = constraint.first_row;
    for (const ConstraintRow& row : constraint.rows) {
      ElementRecorder recorder(data);
      recorder.set_forces(record_row(recorder, row, index));
      collector.add(recorder.recorder(), index++);
    }
  }
  return collector.finish();
}

RecordedEquations record_equation(const MultibodyData& data, const ConstraintRow& row) {
  ElementRecorder recorder(data);
  record_row(recorder, row, 0);
  MultibodyData one;
  one.n_coordinates = data.n_coordinates;
  one.n_constraints = 1;
  BatchCollector collector(one);
  collector.begin(0, "");
  collector.add(recorder.recorder(), 0);
  return collector.finish();
}

void add_costs(const RecordedEquations& equations, std::vector<Effect>& effects) {
  for (const Batch& batch : equations.batches) {
    Effect& effect = effects[batch.kind];
    ++effect.records;
    effect.directions = std::max(effect.directions, batch.derivatives.n_directions);
    effect.operations += static_cast<int>(batch.size * batch.derivatives.instructions.size());
  }
}

}  // namespace eigentrail
