#include "model/evaluate_equations.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace eigentrail {
namespace {

/// Zero if all numbers that were added are finite, else not a number.
template <class Real>
struct Probe {
  Real sum = Real(0.0);
  void add(const Real& value) { sum += Real(0.0) * value; }
  bool is_finite() const { return sum == Real(0.0); }
};

/// Calls add(k, value) for the coefficients of a result.
void for_each_coefficient(const auto& evaluation, int slot, int lane, int order, auto add) {
  const auto* const series = evaluation.series(slot);
  const int top = evaluation.varies(slot) ? order : 0;
  for (int k = 0; k <= top; ++k) add(k, series[k][lane]);
}

/// The matrix whose entries are a row of `sums`. Of a sparse one only those that are not zero are kept.
template <class Real>
BasicSystemMatrix<Real> matrix_of(const Pattern& pattern, const typename BasicPath<Real>::Columns& sums,
                                  int k) {
  using Dense = typename BasicSystemMatrix<Real>::Dense;
  using Sparse = typename BasicSystemMatrix<Real>::Sparse;
  if (!pattern.is_sparse()) return Dense(sums.row(k).reshaped(pattern.rows, pattern.columns));
  Sparse kept(pattern.rows, pattern.columns);
  kept.resizeNonZeros(static_cast<Eigen::Index>(pattern.size()));
  int size = 0;
  for (int j = 0; j < pattern.columns; ++j) {
    kept.outerIndexPtr()[j] = size;
    const auto column = static_cast<std::size_t>(j);
    for (int i = pattern.first[column]; i < pattern.first[column + 1]; ++i) {
      kept.innerIndexPtr()[size] = pattern.row[static_cast<std::size_t>(i)];
      kept.valuePtr()[size] = sums(k, i);
      if (sums(k, i) != Real(0.0)) ++size;
    }
  }
  kept.outerIndexPtr()[pattern.columns] = size;
  kept.resizeNonZeros(size);
  return kept;
}

/// The sums, a row for each coefficient, as a series without trailing coefficients that are zero.
template <class Real>
void take_sums(const Pattern& pattern, const typename BasicPath<Real>::Columns& sums, int top,
               typename BasicLinearization<Real>::Coefficients& result) {
  while (top > 0 && sums.row(top).isZero(Real(0.0))) --top;
  result.clear();
  for (int k = 0; k <= top; ++k) result.push_back(matrix_of<Real>(pattern, sums, k));
}

/// Evaluates the programs of all batches of some equations.
template <class Real>
class EquationRun {
 public:
  EquationRun(const RecordedEquations& equations, const PathValues<Real>& values, EquationWork<Real>& work)
      : equations_(equations), values_(values), work_(work) {}

  EvaluationFault residual(BasicSteadyResidual<Real>& result) {
    for (const Batch& batch : equations_.batches) {
      for_each_element(batch, batch.values, [&](const auto& evaluation, std::size_t element, int lane) {
        add_residual(batch, evaluation, element, lane, result);
      });
    }
    return fault();
  }

  EvaluationFault linearization(BasicLinearization<Real>& result) {
    for (std::size_t target = 0; target < work_.sums.size(); ++target) {
      const auto size = static_cast<Eigen::Index>(equations_.patterns[target].size());
      work_.sums[target].setZero(values_.order + 1, size);
    }
    for (const Batch& batch : equations_.batches) {
      for_each_element(batch, batch.derivatives, [&](const auto& evaluation, std::size_t element, int lane) {
        add_entries(batch, evaluation, element, lane);
      });
    }
    const bool is_finite =
        std::all_of(work_.sums.begin(), work_.sums.end(), [](const auto& sums) { return sums.allFinite(); });
    for (std::size_t i = 0; !is_finite && i < equations_.batches.size(); ++i) {
      const Batch& batch = equations_.batches[i];
      for_each_element(batch, batch.derivatives, [&](const auto& evaluation, std::size_t element, int lane) {
        look_for_fault(batch, evaluation, element, lane);
      });
    }
    const std::array matrices = {&result.M, &result.C, &result.K, &result.A};
    for (std::size_t target = 0; target < matrices.size(); ++target)
      take_sums<Real>(equations_.patterns[target], work_.sums[target], tops_[target], *matrices[target]);
    return fault();
  }

 private:
  EvaluationFault fault() const {
    const auto at = static_cast<std::size_t>(first_fault_);
    return at < equations_.labels.size() ? EvaluationFault{equations_.labels[at]} : EvaluationFault{};
  }

  /// Calls take(evaluation, element, lane) with the results of each element of a batch. A single element
  /// takes the evaluation of one lane.
  void for_each_element(const Batch& batch, const Program& program, auto take) {
    if (batch.size == 1)
      run(batch, program, work_.single, take);
    else
      run(batch, program, work_.several, take);
  }

  /// Runs a program of a batch for all its elements, several at a time.
  template <int Lanes, class Take>
  void run(const Batch& batch, const Program& program, Evaluation<Real, Lanes>& evaluation, Take take) {
    std::vector<typename Evaluation<Real, Lanes>::Functions> functions(
        static_cast<std::size_t>(batch.record.n_functions));
    evaluation.begin(program, values_.order);
    for (std::size_t begin = 0; begin < batch.size; begin += Lanes) {
      const std::size_t count = std::min<std::size_t>(Lanes, batch.size - begin);
      fill(program.numbers, batch.numbers, batch.record.n_numbers, values_.numbers, values_.number_varies,
           begin, count, evaluation);
      fill(program.coordinates, batch.coordinates, batch.record.n_coordinates, values_.coordinates,
           values_.coordinate_varies, begin, count, evaluation);
      for (std::size_t f = 0; f < functions.size(); ++f) {
        for (std::size_t l = 0; l < Lanes; ++l)
          functions[f][l] = batch.functions[(begin + std::min(l, count - 1)) * functions.size() + f];
      }
      evaluation.run(program, functions);
      for (std::size_t l = 0; l < count; ++l) take(evaluation, begin + l, static_cast<int>(l));
    }
  }

  /// Lanes without an element repeat the last one.
  template <int Lanes>
  static void fill(const std::vector<LocalValue>& inputs, const std::vector<int>& all, int n,
                   const typename PathValues<Real>::Columns& columns, const std::vector<char>& varies,
                   std::size_t begin, std::size_t count, Evaluation<Real, Lanes>& evaluation) {
    for (const LocalValue& input : inputs) {
      auto* const series = evaluation.series(input.slot);
      bool any = false;
      std::array<int, Lanes> index;
      for (std::size_t l = 0; l < Lanes; ++l) {
        const std::size_t element = begin + std::min(l, count - 1);
        index[l] = all[element * static_cast<std::size_t>(n) + static_cast<std::size_t>(input.index)];
        any = any || varies[static_cast<std::size_t>(index[l])];
      }
      const Eigen::Index top = any ? columns.rows() - 1 : 0;
      for (Eigen::Index k = 0; k <= top; ++k) {
        for (int l = 0; l < Lanes; ++l) series[k][l] = columns(k, index[static_cast<std::size_t>(l)]);
      }
      evaluation.set_varies(input.slot, any);
    }
  }

  void add_residual(const Batch& batch, const auto& evaluation, std::size_t element, int lane,
                    BasicSteadyResidual<Real>& result) {
    Probe<Real> probe;
    const int* const coordinates =
        batch.coordinates.data() + element * static_cast<std::size_t>(batch.record.n_coordinates);
    for (const LocalValue& force : batch.values.forces) {
      const int row = coordinates[force.index];
      for_each_coefficient(evaluation, force.slot, lane, values_.order, [&](int k, const Real& value) {
        result.force(row, k) -= value;
        probe.add(value);
      });
    }
    if (batch.values.residual >= 0) {
      const int row = batch.rows[element];
      for_each_coefficient(evaluation, batch.values.residual, lane, values_.order,
                           [&](int k, const Real& value) {
                             result.constraint(row, k) = value;
                             probe.add(value);
                           });
    }
    if (!probe.is_finite()) first_fault_ = std::min(first_fault_, batch.labels[element]);
  }

  void add_entries(const Batch& batch, const auto& evaluation, std::size_t element, int lane) {
    const std::vector<Entry>& entries = batch.derivatives.entries;
    const int* position = batch.positions.data() + element * entries.size();
    for (const Entry& entry : entries) {
      const auto target = static_cast<std::size_t>(entry.target);
      const Real sign(entry.target != Target::constraints ? -1.0 : 1.0);
      const auto* const series = evaluation.series(entry.slot);
      const int top = evaluation.varies(entry.slot) ? values_.order : 0;
      Real* const sum = work_.sums[target].col(*position++).data();
      for (int k = 0; k <= top; ++k) sum[k] += sign * series[k][lane];
      tops_[target] = std::max(tops_[target], top);
    }
  }

  void look_for_fault(const Batch& batch, const auto& evaluation, std::size_t element, int lane) {
    Probe<Real> probe;
    for (const Entry& entry : batch.derivatives.entries)
      for_each_coefficient(evaluation, entry.slot, lane, values_.order,
                           [&](int, const Real& value) { probe.add(value); });
    if (!probe.is_finite()) first_fault_ = std::min(first_fault_, batch.labels[element]);
  }

  const RecordedEquations& equations_;
  const PathValues<Real>& values_;
  EquationWork<Real>& work_;
  /// Label of the first element or constraint, in the order of the scene, that gave a number that is not
  /// finite.
  int first_fault_ = std::numeric_limits<int>::max();
  std::array<int, 4> tops_{};  ///< highest coefficients of the sums that may not be zero
};

}  // namespace

template <class Real>
EvaluationFault evaluate_residual(const RecordedEquations& equations, const PathValues<Real>& values,
                                  EquationWork<Real>& work, BasicSteadyResidual<Real>& result) {
  return EquationRun<Real>(equations, values, work).residual(result);
}

template <class Real>
EvaluationFault evaluate_linearization(const RecordedEquations& equations, const PathValues<Real>& values,
                                       EquationWork<Real>& work, BasicLinearization<Real>& result) {
  return EquationRun<Real>(equations, values, work).linearization(result);
}

template EvaluationFault evaluate_residual(const RecordedEquations&, const PathValues<double>&,
                                           EquationWork<double>&, SteadyResidual&);
template EvaluationFault evaluate_residual(const RecordedEquations&, const PathValues<Extended>&,
                                           EquationWork<Extended>&, BasicSteadyResidual<Extended>&);
template EvaluationFault evaluate_linearization(const RecordedEquations&, const PathValues<double>&,
                                                EquationWork<double>&, Linearization&);
template EvaluationFault evaluate_linearization(const RecordedEquations&, const PathValues<Extended>&,
                                                EquationWork<Extended>&, BasicLinearization<Extended>&);

}  // namespace eigentrail
