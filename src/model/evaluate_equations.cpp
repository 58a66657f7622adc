#include "model/evaluate_equations.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Runs a program of a batch for all its elements, several at a time, and lets `take(element, lane)` use the
/// results of each.
template <class Real>
class BatchRun {
 public:
  BatchRun(const Batch& batch, const PathValues<Real>& values) : batch_(batch), values_(values) {}

  template <int Lanes, class Take>
  void run(const Program& program, Evaluation<Real, Lanes>& evaluation, Take take) const {
    std::vector<typename Evaluation<Real, Lanes>::Functions> functions(
        static_cast<std::size_t>(batch_.record.n_functions));
    evaluation.begin(program, values_.order);
    for (std::size_t begin = 0; begin < batch_.size; begin += Lanes) {
      const std::size_t count = std::min<std::size_t>(Lanes, batch_.size - begin);
      fill(program.numbers, batch_.numbers, batch_.record.n_numbers, values_.numbers, values_.number_varies,
           begin, count, evaluation);
      fill(program.coordinates, batch_.coordinates, batch_.record.n_coordinates, values_.coordinates,
           values_.coordinate_varies, begin, count, evaluation);
      for (std::size_t f = 0; f < functions.size(); ++f) {
        for (std::size_t l = 0; l < Lanes; ++l)
          functions[f][l] = batch_.functions[(begin + std::min(l, count - 1)) * functions.size() + f];
      }
      evaluation.run(program, functions);
      for (std::size_t l = 0; l < count; ++l) take(begin + l, static_cast<int>(l));
    }
  }

 private:
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

  const Batch& batch_;
  const PathValues<Real>& values_;
};

/// The first element or constraint, in the order of the scene, that gave a number that is not finite.
class FirstFault {
 public:
  explicit FirstFault(const RecordedEquations& equations) : equations_(equations) {}

  void note(int label) { first_ = first_ < 0 ? label : std::min(first_, label); }

  EvaluationFault fault() const {
    if (first_ < 0) return {};
    return {equations_.labels[static_cast<std::size_t>(first_)]};
  }

 private:
  const RecordedEquations& equations_;
  int first_ = -1;
};

/// Zero if all numbers that were added are finite, else not a number.
template <class Real>
struct Probe {
  Real sum = Real(0.0);
  void add(const Real& value) { sum += Real(0.0) * value; }
  bool is_finite() const { return sum == Real(0.0); }
};

/// Calls add(k, value) for the coefficients of a result.
template <class Evaluation, class Add>
int for_each_coefficient(const Evaluation& evaluation, int slot, int lane, int order, Add add) {
  const auto* const series = evaluation.series(slot);
  const int top = evaluation.varies(slot) ? order : 0;
  for (int k = 0; k <= top; ++k) add(k, series[k][lane]);
  return top;
}

template <class Real>
BasicSystemMatrix<Real> matrix_of(const Pattern& pattern, const Real* entries) {
  using Matrix = typename BasicSystemMatrix<Real>::Dense;
  if (!pattern.is_sparse()) return Matrix(Eigen::Map<const Matrix>(entries, pattern.rows, pattern.columns));
  typename BasicSystemMatrix<Real>::Sparse matrix(pattern.rows, pattern.columns);
  matrix.reserve(static_cast<Eigen::Index>(pattern.size()));
  for (int column = 0; column < pattern.columns; ++column) {
    matrix.startVec(column);
    const auto at = static_cast<std::size_t>(column);
    for (int i = pattern.first[at]; i < pattern.first[at + 1]; ++i) {
      if (entries[i] != Real(0.0))
        matrix.insertBack(pattern.row[static_cast<std::size_t>(i)], column) = entries[i];
    }
  }
  matrix.finalize();
  return matrix;
}

/// The sum as a series without trailing coefficients that are zero.
template <class Real>
void take_sum(const Pattern& pattern, const typename BasicPath<Real>::Columns& sum, int top,
              typename BasicLinearization<Real>::Coefficients& result) {
  while (top > 0 && sum.col(top).isZero(Real(0.0))) --top;
  result.clear();
  for (int k = 0; k <= top; ++k) result.push_back(matrix_of<Real>(pattern, sum.col(k).data()));
}

/// Evaluates the programs of all batches of some equations.
template <class Real>
class EquationRun {
 public:
  EquationRun(const RecordedEquations& equations, const PathValues<Real>& values, EquationWork<Real>& work)
      : equations_(equations), values_(values), work_(work), faults_(equations) {}

  EvaluationFault residual(BasicSteadyResidual<Real>& result) {
    for (const Batch& batch : equations_.batches) {
      for_each_element(batch, batch.values, [&](const auto& evaluation, std::size_t element, int lane) {
        add_residual(batch, evaluation, element, lane, result);
      });
    }
    return faults_.fault();
  }

  EvaluationFault linearization(BasicLinearization<Real>& result) {
    for (std::size_t target = 0; target < work_.sums.size(); ++target) {
      const auto size = static_cast<Eigen::Index>(equations_.patterns[target].size());
      work_.sums[target].setZero(size, values_.order + 1);
    }
    for (const Batch& batch : equations_.batches) {
      for_each_element(batch, batch.derivatives, [&](const auto& evaluation, std::size_t element, int lane) {
        add_entries(batch, evaluation, element, lane);
      });
    }
    const std::array matrices = {&result.M, &result.C, &result.K, &result.A};
    for (std::size_t target = 0; target < matrices.size(); ++target)
      take_sum<Real>(equations_.patterns[target], work_.sums[target], tops_[target], *matrices[target]);
    return faults_.fault();
  }

 private:
  /// Calls take(evaluation, element, lane). A single element takes the evaluation of one lane.
  template <class Take>
  void for_each_element(const Batch& batch, const Program& program, Take take) {
    const BatchRun<Real> run(batch, values_);
    const auto with = [&](auto& evaluation) {
      run.run(program, evaluation, [&](std::size_t element, int lane) { take(evaluation, element, lane); });
    };
    if (batch.size == 1)
      with(work_.single);
    else
      with(work_.several);
  }

  template <class Evaluation>
  void add_residual(const Batch& batch, const Evaluation& evaluation, std::size_t element, int lane,
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
    if (!probe.is_finite()) faults_.note(batch.labels[element]);
  }

  template <class Evaluation>
  void add_entries(const Batch& batch, const Evaluation& evaluation, std::size_t element, int lane) {
    Probe<Real> probe;
    const std::vector<Entry>& entries = batch.derivatives.entries;
    const int* position = batch.positions.data() + element * entries.size();
    for (const Entry& entry : entries) {
      const auto target = static_cast<std::size_t>(entry.target);
      auto& sum = work_.sums[target];
      const bool of_force = entry.target != Target::constraints;
      const int at = *position++;
      const int top =
          for_each_coefficient(evaluation, entry.slot, lane, values_.order, [&](int k, const Real& value) {
            sum(at, k) += of_force ? -value : value;
            probe.add(value);
          });
      tops_[target] = std::max(tops_[target], top);
    }
    if (!probe.is_finite()) faults_.note(batch.labels[element]);
  }

  const RecordedEquations& equations_;
  const PathValues<Real>& values_;
  EquationWork<Real>& work_;
  FirstFault faults_;
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
