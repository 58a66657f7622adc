// Elements and constraints as records: every force is called once with a scalar that records it, and elements
// with equal records form a batch that is evaluated together. What is in no scene is in no batch.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/multibody_data.hpp"
#include "model/record/program.hpp"
#include "model/record/slots.hpp"
#include "model/record/smooth_function.hpp"

namespace eigentrail {

/// Number of coordinates from which matrices are sparse. For chains of rods, sparse and dense matrices take
/// the same time at about 80 coordinates (docs/developers/performance.md).
inline constexpr int sparse_from = 100;

/// Elements of one kind and structure. The lists have the inputs of all elements, one element after the
/// other.
struct Batch {
  std::size_t kind = 0;  ///< index of the effect
  Record record;
  Program values, derivatives;
  std::size_t size = 0;          ///< number of elements
  std::vector<int> numbers;      ///< by slot; the multipliers follow the quantities
  std::vector<int> coordinates;  ///< of the model
  std::vector<const SmoothFunction*> functions;
  std::vector<int> rows;    ///< of the constraints; empty if the elements have no residual
  std::vector<int> labels;  ///< indices into RecordedEquations::labels
  /// Positions of the entries of `derivatives` in the patterns of their targets.
  std::vector<int> positions;
};

/// The entries of a matrix as an array: all of a small one, column by column; of a large one those that an
/// element may have.
struct Pattern {
  int rows = 0, columns = 0;
  std::vector<int> first;  ///< of each column, and the number of all; empty: dense
  std::vector<int> row;    ///< of each entry, ascending within a column

  bool is_sparse() const { return !first.empty(); }
  std::size_t size() const {
    return is_sparse() ? row.size() : static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
  int position(int at_row, int at_column) const;
};

/// Equations of some elements and constraints of a model with n coordinates and m constraints.
struct RecordedEquations {
  int n = 0, m = 0;
  std::vector<Batch> batches;
  std::vector<std::string> labels;    ///< of elements and constraints, in the order of the scene
  std::vector<std::uint64_t> counts;  ///< occurrences by kind, see EvaluationCounts
  std::array<Pattern, 4> patterns;    ///< of M, C, K and A, by Target
  std::array<Inputs, 4> inputs;       ///< of their entries; numbers by slot, multipliers behind quantities
  Inputs inputs_of_residual;          ///< of steady forces and of the left sides of constraints
};

/// Of elements and constraints that belong to `data`, not necessarily all of it. Slots of multipliers follow
/// those of its quantities.
RecordedEquations record_equations(const MultibodyData& data, const Elements& elements,
                                   const std::vector<Constraint>& constraints);

/// The equation c = 0 of a row alone, without its forces.
RecordedEquations record_equation(const MultibodyData& data, const ConstraintRow& row);

/// Adds the cost of what is recorded to the effects of a model.
void add_costs(const RecordedEquations& equations, std::vector<Effect>& effects);

}  // namespace eigentrail
