#include "eigentrail/model/affine_family.hpp"

#include <algorithm>
#include <type_traits>

#include "core/gaps.hpp"
#include "eigentrail/model/sample_errors.hpp"
#include "model/affine_factor.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {
namespace {

template <class Storage>
std::vector<Effect> effects_of(const AffinePencil<Storage>& pencil) {
  const auto count = [](const auto& terms) { return static_cast<int>(terms.size()); };
  return {{"M", "mass matrix, sum of terms with factors", count(pencil.M), {.inertia = true}},
          {"C", "damping and gyroscopic matrix", count(pencil.C), damping_parts(pencil.C)},
          {"K", "stiffness matrix", count(pencil.K), stiffness_parts(pencil.K)}};
}

template <class Storage>
bool depends_on(const AffineTerm<Storage>& term, const Parameters& parameters, int traced) {
  return parameters.depends_on(term.factor, traced) || parameters.depends_on(term.scale, traced);
}

template <class Storage>
bool are_constant(const std::vector<AffineTerm<Storage>>& terms, const Parameters& parameters, int traced) {
  return std::none_of(terms.begin(), terms.end(),
                      [&](const AffineTerm<Storage>& term) { return depends_on(term, parameters, traced); });
}

// Errors of eigenvalues that come from tables of coefficients: what their interpolants miss between the rows.

/// The argument of a table as a linear function of one parameter: at + slope * parameter.
struct TableArgument {
  int parameter = -1;
  double at = 0.0, slope = 1.0;

  double of(double p) const { return at + slope * p; }
  double parameter_at(double value) const { return (value - at) / slope; }
  bool operator==(const TableArgument&) const = default;
};

/// Empty for an expression that is none.
std::optional<TableArgument> linear_argument(const Expression& expression) {
  if (expression.parameters().size() != 1) return std::nullopt;
  const int parameter = expression.parameters().front();
  const auto at = [&](double p) {
    std::vector<Series<double, 2>> values(static_cast<std::size_t>(parameter) + 1);
    values.back()[0] = p;
    values.back()[1] = 1.0;
    return expression.evaluate(std::span<const Series<double, 2>>(values));
  };
  const Series<double, 2> zero = at(0.0), one = at(1.0);
  const bool is_linear = zero[2] == 0.0 && one[2] == 0.0 && zero[1] == one[1] && zero[1] != 0.0;
  return is_linear ? std::optional(TableArgument{parameter, zero[0], zero[1]}) : std::nullopt;
}

/// The part of the matrices that comes from one table, at each of its rows.
struct OneTable {
  TableArgument argument;
  std::shared_ptr<const SamplePiece> piece;
  std::vector<SamplePiece> pieces = {*piece};
  std::array<PencilSamples, 3> samples = {};
  std::unique_ptr<InterpolationErrors> errors = nullptr;

  const std::vector<double>& values() const { return piece->interpolant.nodes(); }  ///< of the argument
};

class TableErrors final : public SampleErrors {
 public:
  explicit TableErrors(std::vector<std::unique_ptr<OneTable>> tables)
      : parameter_(tables.front()->argument.parameter), tables_(std::move(tables)) {
    for (const auto& table : tables_) {
      for (const double value : table->values()) values_.push_back(table->argument.parameter_at(value));
    }
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
      const std::size_t own_gap = gap_of(table->values(), table->argument.of(middle));
      const SampleBounds one = table->errors->between(own_gap, triples);
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
    for (const auto& table : tables_)
      largest = std::max(largest, table->errors->shape(table->argument.of(x)));
    return largest;
  }

  double place_of_largest_error(std::size_t, double from, double to) const override {
    const OneTable& first = *tables_.front();
    const TableArgument& argument = first.argument;
    const auto [low, high] = std::minmax(argument.of(from), argument.of(to));
    const std::size_t own_gap = gap_of(first.values(), 0.5 * (low + high));
    return argument.parameter_at(first.errors->place_of_largest_error(own_gap, low, high));
  }

 private:
  int parameter_;
  std::vector<std::unique_ptr<OneTable>> tables_;
  std::vector<double> values_;
};

/// The table with these rows over this argument among those that were found; a new one if there is none yet.
OneTable& table_with(std::vector<std::unique_ptr<OneTable>>& tables,
                     const std::shared_ptr<const SamplePiece>& piece, const TableArgument& argument) {
  for (const auto& table : tables) {
    if (table->piece == piece && table->argument == argument) return *table;
  }
  return *tables.emplace_back(std::make_unique<OneTable>(OneTable{argument, piece}));
}

/// Adds a term to the samples of a coefficient of s^2 M + s C + K.
void add_samples(PencilSamples& samples, const AffineTerm<Matrix>& term) {
  const std::vector<double>& values = term.table->values();
  if (samples.samples.empty())
    samples.samples.assign(values.size(), Matrix::Zero(term.matrix.rows(), term.matrix.cols()));
  for (std::size_t i = 0; i < values.size(); ++i) samples.samples[i] += values[i] * term.matrix;
}

/// Of tables whose errors are not known.
class UnknownErrors final : public SampleErrors {
 public:
  int parameter() const override { return no_parameter; }
  const std::vector<double>& values() const override { return no_values_; }
  SampleBounds between(std::size_t, std::span<const EigenTriple>) const override { return {}; }
  double shape(double) const override { return 0.0; }
  double place_of_largest_error(std::size_t, double from, double) const override { return from; }

 private:
  std::vector<double> no_values_;
};

template <class Storage>
bool interpolates(const AffinePencil<Storage>& pencil) {
  const auto has_table = [](const AffineTerm<Storage>& term) {
    return term.table && !term.table->is_exact();
  };
  return std::ranges::any_of(pencil.M, has_table) || std::ranges::any_of(pencil.C, has_table) ||
         std::ranges::any_of(pencil.K, has_table);
}

/// The errors of all tables of a family together; null if there are none, or if the argument of a table is
/// not a linear function of one parameter, the same for all. The bounds of the tables add up.
std::unique_ptr<const SampleErrors> table_errors(const AffinePencil<Matrix>& pencil, Eigen::Index n) {
  std::vector<std::unique_ptr<OneTable>> tables;
  std::size_t coefficient = 0;
  for (const auto* terms : {&pencil.M, &pencil.C, &pencil.K}) {
    for (const AffineTerm<Matrix>& term : *terms) {
      if (!term.table || term.table->is_exact()) continue;
      const auto argument = linear_argument(term.factor);
      if (!argument || (!tables.empty() && tables.front()->argument.parameter != argument->parameter))
        return nullptr;
      add_samples(table_with(tables, term.table->piece(), *argument).samples[coefficient], term);
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
    table->errors = std::make_unique<InterpolationErrors>(table->argument.parameter, table->values(),
                                                          table->samples, table->pieces);
  }
  return std::make_unique<TableErrors>(std::move(tables));
}

}  // namespace

template <class Storage>
AffineFamily<Storage>::AffineFamily(ModelDescription description, AffinePencil<Storage> pencil)
    : MatrixModel([&] {
        if (description.effects.empty()) description.effects = effects_of(pencil);
        return std::move(description);
      }()),
      pencil_(std::move(pencil)) {
  if constexpr (std::is_same_v<Storage, Matrix>) errors_ = table_errors(pencil_, n_coordinates());
  if (!errors_ && interpolates(pencil_)) errors_ = std::make_shared<UnknownErrors>();
}

template <class Storage>
AffinePencil<Storage> AffineFamily<Storage>::at(const Vector& parameters) const {
  const auto si = si_series<double, 0>(description().parameters, {parameters, {}, {}});
  AffinePencil<Storage> result;
  const auto sum = [&](const std::vector<AffineTerm<Storage>>& terms) {
    std::vector<AffineTerm<Storage>> one(1);
    one.front().matrix.resize(n_coordinates(), n_coordinates());
    one.front().matrix.setZero();
    for (const AffineTerm<Storage>& term : terms)
      one.front().matrix += factor_of(term, std::span<const Series<double, 0>>(si))[0] * term.matrix;
    return one;
  };
  return {sum(pencil_.M), sum(pencil_.C), sum(pencil_.K)};
}

template <class Storage>
Structure AffineFamily<Storage>::structure(int traced_parameter) const {
  Structure result = structure_of_effects();
  const Parameters& parameters = description().parameters;
  result.symmetric_mass = all_equal_transposes(pencil_.M, 1.0);
  result.constant_mass = are_constant(pencil_.M, parameters, traced_parameter);
  result.constant_damping = are_constant(pencil_.C, parameters, traced_parameter);
  result.constant_stiffness = are_constant(pencil_.K, parameters, traced_parameter);
  result.constant_constraints = are_constant(pencil_.A, parameters, traced_parameter);
  return result;
}

template <class Storage>
template <class Real, int Q>
EvaluationFault AffineFamily<Storage>::evaluate_all(const BasicPath<Real>& path, int order,
                                                    BasicLinearization<Real>& result) const {
  using Dense = SeriesSum<typename BasicSystemMatrix<Real>::Dense, Q>;
  using Sparse = SeriesSum<typename BasicSystemMatrix<Real>::Sparse, Q>;
  using Sum = std::conditional_t<std::is_same_v<Storage, SparseMatrix>, Sparse, Dense>;
  const auto si = si_series<Real, Q>(description().parameters, path);
  EvaluationFault fault;
  const auto evaluate = [&](auto sum, const std::vector<AffineTerm<Storage>>& terms, const char* name) {
    for (const AffineTerm<Storage>& term : terms)
      sum.add(factor_of(term, std::span<const Series<Real, Q>>(si)), term.matrix);
    if (!sum.is_finite() && !fault) fault.source = name;
    return sum.take();
  };
  const Eigen::Index n = n_coordinates();
  result.M = evaluate(Sum(n, n, order), pencil_.M, "matrix M");
  result.C = evaluate(Sum(n, n, order), pencil_.C, "matrix C");
  result.K = evaluate(Sum(n, n, order), pencil_.K, "matrix K");
  result.A = evaluate(Dense(n_constraints(), n, order), pencil_.A, "matrix A");
  return fault;
}

template <class Storage>
EvaluationFault AffineFamily<Storage>::linearize(const Path& path, int order, Linearization& result,
                                                 EvaluationCounts& counts) const {
  for (std::size_t i = 0; i < counts.linearization.size(); ++i) {
    if (description().effects[i].count > 0) ++counts.linearization[i];
  }
  return evaluate_all<double, max_order>(path, order, result);
}

template <class Storage>
CoefficientMatrices AffineFamily<Storage>::coefficient_matrices(const Vector& parameters, int traced) const {
  CoefficientMatrices result;
  if constexpr (std::is_same_v<Storage, Matrix>) {
    if (n_constraints() > 0) return result;
    const auto si = si_series<double, 0>(description().parameters, {parameters, {}, {}});
    const auto take = [&](const std::vector<AffineTerm<Matrix>>& terms, std::vector<Matrix>& matrices) {
      Matrix constant = Matrix::Zero(n_coordinates(), n_coordinates());
      for (const AffineTerm<Matrix>& term : terms) {
        if (depends_on(term, description().parameters, traced)) {
          matrices.push_back(term.matrix);
        } else {
          constant += factor_of(term, std::span<const Series<double, 0>>(si))[0] * term.matrix;
        }
      }
      if (!constant.isZero(0.0)) matrices.push_back(std::move(constant));
    };
    take(pencil_.M, result.M);
    take(pencil_.C, result.C);
    take(pencil_.K, result.K);
  }
  return result;
}

template <class Storage>
std::vector<Expression> AffineFamily<Storage>::expressions() const {
  std::vector<Expression> all;
  for (const auto* terms : {&pencil_.M, &pencil_.C, &pencil_.K, &pencil_.A}) {
    for (const AffineTerm<Storage>& term : *terms) {
      // A tabulated factor is as smooth as the steps between the rows of its table.
      if (term.table) continue;
      const bool known = std::find(all.begin(), all.end(), term.factor) != all.end();
      if (!term.factor.is_constant() && !known) all.push_back(term.factor);
    }
  }
  return all;
}

template <class Storage>
EvaluationFault AffineFamily<Storage>::extended_linearization(const BasicPath<Extended>& path,
                                                              BasicLinearization<Extended>& result) const {
  return evaluate_all<Extended, 0>(path, 0, result);
}

template class AffineFamily<SparseMatrix>;
template class AffineFamily<Matrix>;

}  // namespace eigentrail
