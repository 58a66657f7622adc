#include "model/rotor/table_errors.hpp"

#include <algorithm>

#include "core/gaps.hpp"
#include "model/tabulated_factor.hpp"

namespace eigentrail {
namespace {

/// The part of the matrices that comes from one table, at each of its rows.
struct OneTable {
  std::vector<double> values;
  std::vector<SamplePiece> pieces;  ///< one
  std::array<PencilSamples, 3> samples;
  std::unique_ptr<InterpolationErrors> errors = nullptr;
};

class TableErrors final : public SampleErrors {
 public:
  TableErrors(int parameter, std::vector<std::unique_ptr<OneTable>> tables)
      : parameter_(parameter), tables_(std::move(tables)) {
    for (const auto& table : tables_)
      values_.insert(values_.end(), table->values.begin(), table->values.end());
    std::sort(values_.begin(), values_.end());
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
  }

  int parameter() const override { return parameter_; }
  const std::vector<double>& values() const override { return values_; }

  SampleBounds between(std::size_t gap, std::span<const EigenTriple> triples) const override {
    const double middle = 0.5 * (values_[gap] + values_[gap + 1]);
    const auto count = static_cast<Eigen::Index>(triples.size());
    const Vector none = Vector::Zero(count);
    SampleBounds sum{none, none, none, none, none};
    for (const auto& table : tables_) {
      const SampleBounds one = table->errors->between(gap_of(table->values, middle), triples);
      sum.smooth += one.smooth;
      sum.rough += one.rough;
      sum.digits += one.digits;
      sum.smooth_growth += one.smooth_growth;
      sum.rough_growth += one.rough_growth;
    }
    return sum;
  }

  double shape(double x) const override {
    double largest = 0.0;
    for (const auto& table : tables_) largest = std::max(largest, table->errors->shape(x));
    return largest;
  }

  double place_of_largest_error(std::size_t, double from, double to) const override {
    const OneTable& first = *tables_.front();
    return first.errors->place_of_largest_error(gap_of(first.values, 0.5 * (from + to)), from, to);
  }

 private:
  int parameter_;
  std::vector<std::unique_ptr<OneTable>> tables_;
  std::vector<double> values_;
};

/// The parameter that an expression is; -1 if it is none.
int parameter_of(const Expression& expression) {
  const std::vector<int>& used = expression.parameters();
  const bool alone = used.size() == 1 && expression == Expression::of_parameter(used.front());
  return alone ? used.front() : -1;
}

/// The table with these rows among those that were found; a new one if there is none yet.
OneTable& table_with(std::vector<std::unique_ptr<OneTable>>& tables,
                     std::vector<std::shared_ptr<const SamplePiece>>& known,
                     const std::shared_ptr<const SamplePiece>& piece) {
  const auto found = std::find(known.begin(), known.end(), piece);
  if (found != known.end()) return *tables[static_cast<std::size_t>(found - known.begin())];
  known.push_back(piece);
  auto table = std::make_unique<OneTable>();
  table->values = piece->interpolant.nodes();
  table->pieces = {*piece};
  return *tables.emplace_back(std::move(table));
}

/// Adds a term to the samples of a coefficient of s^2 M + s C + K.
void add_samples(PencilSamples& samples, const AffineTerm<Matrix>& term) {
  const std::vector<double>& values = term.table->values();
  if (samples.samples.empty())
    samples.samples.assign(values.size(), Matrix::Zero(term.matrix.rows(), term.matrix.cols()));
  for (std::size_t i = 0; i < values.size(); ++i) samples.samples[i] += values[i] * term.matrix;
}

}  // namespace

std::unique_ptr<const SampleErrors> table_errors(const AffinePencil<Matrix>& pencil, Eigen::Index n) {
  std::vector<std::unique_ptr<OneTable>> tables;
  std::vector<std::shared_ptr<const SamplePiece>> known;
  int parameter = -1;
  std::size_t coefficient = 0;
  for (const auto* terms : {&pencil.M, &pencil.C, &pencil.K}) {
    for (const AffineTerm<Matrix>& term : *terms) {
      if (!term.table || term.table->is_exact()) continue;
      const int argument = parameter_of(term.factor);
      if (argument < 0 || (parameter >= 0 && parameter != argument)) return nullptr;
      parameter = argument;
      add_samples(table_with(tables, known, term.table->piece()).samples[coefficient], term);
    }
    ++coefficient;
  }
  if (tables.empty()) return nullptr;
  for (const auto& table : tables) {
    for (int i = 0; i < 3; ++i) {
      PencilSamples& samples = table->samples[static_cast<std::size_t>(i)];
      samples.power = 2 - i;
      if (samples.samples.empty()) samples.samples = {Matrix::Zero(n, n)};
    }
    table->errors =
        std::make_unique<InterpolationErrors>(parameter, table->values, table->samples, table->pieces);
  }
  return std::make_unique<TableErrors>(parameter, std::move(tables));
}

}  // namespace eigentrail
