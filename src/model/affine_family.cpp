#include "eigentrail/model/affine_family.hpp"

#include <algorithm>
#include <type_traits>

#include "model/affine_factor.hpp"
#include "model/rotor/table_errors.hpp"
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

}  // namespace

template <class Storage>
AffineFamily<Storage>::AffineFamily(ModelDescription description, AffinePencil<Storage> pencil)
    : MatrixModel([&] {
        if (description.effects.empty()) description.effects = effects_of(pencil);
        return std::move(description);
      }()),
      pencil_(std::move(pencil)) {
  if constexpr (std::is_same_v<Storage, Matrix>) errors_ = table_errors(pencil_, n_coordinates());
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
