#include "model/matrix_family.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/transposition.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {

namespace {

/// The polynomial along the path, for parameters `si`.
template <class Real, int Q>
DenseSum<Real, Q> evaluate(const MatrixPolynomial& polynomial, Eigen::Index rows, Eigen::Index columns,
                           int variable, const std::vector<Series<Real, Q>>& si, int order) {
  using Scalar = Series<Real, Q>;
  DenseSum<Real, Q> sum(rows, columns, order);
  std::vector<Scalar> powers;
  for (const Matrix& coefficient : polynomial.coefficients) {
    powers.push_back(powers.empty() ? Scalar(1.0) : powers.back() * si[static_cast<std::size_t>(variable)]);
    sum.add(powers.back(), coefficient);
  }
  for (const MatrixPolynomial::Entry& entry : polynomial.entries) {
    const Scalar value = entry.expression.evaluate(std::span<const Scalar>(si));
    sum.add(value * powers[static_cast<std::size_t>(entry.power)], entry.row, entry.column);
  }
  return sum;
}

/// Values of the parameters at which expressions are compared: those of the scene, and others beside them.
std::vector<Vector> places_to_compare(const Parameters& parameters) {
  constexpr int count = 3;
  std::vector<Vector> places;
  for (int place = 0; place < count; ++place) {
    Vector values = parameters.declared_values();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      // Golden ratio: the fractional parts of its multiples are all different.
      const double share = std::fmod(static_cast<double>(place * (i + 1)) * std::numbers::phi, 1.0);
      values[i] += share * (1.0 + std::abs(values[i]));
    }
    parameters.to_si(std::span<double>(values.data(), parameters.size()));
    places.push_back(std::move(values));
  }
  return places;
}

/// Whether two expressions are `sign` times each other. They may be written differently ("a*b" and "b*a"), as
/// long as they have the same values.
bool agree(const Expression& a, const Expression& b, double sign, const std::vector<Vector>& places) {
  return std::all_of(places.begin(), places.end(), [&](const Vector& place) {
    const std::span<const double> si(place.data(), static_cast<std::size_t>(place.size()));
    return a.evaluate(si) == sign * b.evaluate(si);
  });
}

/// Whether a matrix is given, but has no entries: it is absent.
bool is_zero(const MatrixPolynomial& polynomial) {
  return polynomial.entries.empty() &&
         std::all_of(polynomial.coefficients.begin(), polynomial.coefficients.end(),
                     [](const Matrix& c) { return c.isZero(0.0); });
}

/// Whether a matrix is symmetric (sign 1) or skew-symmetric (-1). An entry that is an expression needs its
/// counterpart across the diagonal.
bool equals_its_transpose(const MatrixPolynomial& polynomial, double sign, const Parameters& parameters) {
  if (!all_equal_transposes(polynomial.coefficients, sign)) return false;
  const std::vector<Vector> places = places_to_compare(parameters);
  std::map<std::array<Eigen::Index, 3>, const Expression*> entries;
  for (const MatrixPolynomial::Entry& entry : polynomial.entries)
    entries[{entry.power, entry.row, entry.column}] = &entry.expression;
  return std::all_of(entries.begin(), entries.end(), [&](const auto& entry) {
    const auto& [power, row, column] = entry.first;
    const auto across = entries.find({power, column, row});
    return across != entries.end() && agree(*entry.second, *across->second, sign, places);
  });
}

}  // namespace

MatrixFamily::MatrixFamily(ModelDescription description, int variable, MatrixPolynomial M, MatrixPolynomial C,
                           MatrixPolynomial K, MatrixPolynomial A, FamilyForm form)
    : MatrixModel([&] {
        const auto count = [](const MatrixPolynomial& p) {
          return is_zero(p) ? 0 : static_cast<int>(p.coefficients.size());
        };
        if (form == FamilyForm::first_order) {
          description.effects = {
              {"M", "mass matrix", 0, {.inertia = true}},
              {"E", "matrix of the derivatives", count(C), {.dissipative = true, .gyroscopic = true}},
              {"A", "state matrix", count(K), {.conservative = true, .circulatory = true}},
              {"constraints", "constraint matrix", 0, {.constraint = true}}};
          return std::move(description);
        }
        const Parameters& parameters = description.parameters;
        const bool symmetric_C = equals_its_transpose(C, 1.0, parameters);
        description.effects = {
            {"M", "mass matrix, polynomial in the traced parameter", count(M), {.inertia = true}},
            {"C",
             "damping and gyroscopic matrix",
             count(C),
             {.dissipative = symmetric_C || !equals_its_transpose(C, -1.0, parameters),
              .gyroscopic = !symmetric_C}},
            {"K",
             "stiffness matrix",
             count(K),
             {.conservative = true, .circulatory = !equals_its_transpose(K, 1.0, parameters)}},
            {"A", "constraint matrix", count(A), {.constraint = true}}};
        return std::move(description);
      }()),
      variable_(variable),
      M_(std::move(M)),
      C_(std::move(C)),
      K_(std::move(K)),
      A_(std::move(A)) {}

std::vector<Expression> MatrixFamily::expressions() const {
  std::vector<Expression> all;
  for (const MatrixPolynomial* polynomial : {&M_, &C_, &K_, &A_}) {
    for (const MatrixPolynomial::Entry& entry : polynomial->entries) {
      if (std::find(all.begin(), all.end(), entry.expression) == all.end()) all.push_back(entry.expression);
    }
  }
  return all;
}

bool MatrixFamily::constant(const MatrixPolynomial& polynomial, int traced_parameter) const {
  const Parameters& parameters = description().parameters;
  if (polynomial.coefficients.size() > 1 && parameters.depends_on(variable_, traced_parameter)) return false;
  return std::none_of(polynomial.entries.begin(), polynomial.entries.end(),
                      [&](const MatrixPolynomial::Entry& entry) {
                        return parameters.depends_on(entry.expression, traced_parameter);
                      });
}

Structure MatrixFamily::structure(int traced_parameter) const {
  Structure result = structure_of_effects();
  result.symmetric_mass = equals_its_transpose(M_, 1.0, description().parameters);
  result.constant_mass = constant(M_, traced_parameter);
  result.constant_damping = constant(C_, traced_parameter);
  result.constant_stiffness = constant(K_, traced_parameter);
  result.constant_constraints = constant(A_, traced_parameter);
  return result;
}

namespace {

/// The constant matrices of a polynomial. Entries with the same expression and power have one of their own.
std::vector<Matrix> coefficients_of(const MatrixPolynomial& polynomial, Eigen::Index n) {
  std::vector<const MatrixPolynomial::Entry*> first;
  std::vector<Matrix> own;
  for (const MatrixPolynomial::Entry& entry : polynomial.entries) {
    const auto same = std::find_if(first.begin(), first.end(), [&](const MatrixPolynomial::Entry* other) {
      return other->power == entry.power && other->expression == entry.expression;
    });
    const auto at = static_cast<std::size_t>(same - first.begin());
    if (same == first.end()) {
      first.push_back(&entry);
      own.emplace_back(Matrix::Zero(n, n));
    }
    own[at](entry.row, entry.column) = 1.0;
  }
  own.insert(own.end(), polynomial.coefficients.begin(), polynomial.coefficients.end());
  return own;
}

}  // namespace

CoefficientMatrices MatrixFamily::coefficient_matrices(const Vector&, int) const {
  if (n_constraints() > 0) return {};
  const Eigen::Index n = n_coordinates();
  return {coefficients_of(M_, n), coefficients_of(C_, n), coefficients_of(K_, n)};
}

template <class Real, int Q>
EvaluationFault MatrixFamily::evaluate_all(const BasicPath<Real>& path, int order,
                                           BasicLinearization<Real>& result, EvaluationCounts& counts) const {
  const auto si = si_series<Real, Q>(description().parameters, path);
  const Eigen::Index n = n_coordinates();
  EvaluationFault fault;
  std::size_t effect = 0;
  const auto evaluate_one = [&](const MatrixPolynomial& polynomial, Eigen::Index rows, const char* name) {
    DenseSum<Real, Q> sum = evaluate<Real, Q>(polynomial, rows, n, variable_, si, order);
    if (!sum.is_finite() && !fault) fault.source = name;
    if (!polynomial.empty()) ++counts.linearization[effect];
    ++effect;
    return sum.take();
  };
  result.M = evaluate_one(M_, n, "matrix M");
  result.C = evaluate_one(C_, n, "matrix C");
  result.K = evaluate_one(K_, n, "matrix K");
  result.A = evaluate_one(A_, n_constraints(), "matrix A");
  return fault;
}

EvaluationFault MatrixFamily::linearize(const Path& path, int order, Linearization& result,
                                        EvaluationCounts& counts) const {
  return evaluate_all<double, max_order>(path, order, result, counts);
}

EvaluationFault MatrixFamily::extended_linearization(const BasicPath<Extended>& path,
                                                     BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return evaluate_all<Extended, 0>(path, 0, result, counts);
}

}  // namespace eigentrail
