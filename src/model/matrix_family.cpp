#include "model/matrix_family.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

namespace eigentrail {

/// SI values of the parameters along the path, and the variable of the family.
template <class Scalar>
struct ParameterSeries {
  Scalar variable;
  std::vector<Scalar> si;
};

namespace {

template <class Real, int Q>
ParameterSeries<Series<Real, Q>> parameter_series(const Parameters& parameters, int variable,
                                                  const BasicPath<Real>& path) {
  ParameterSeries<Series<Real, Q>> result;
  result.si.resize(parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    for (int k = 0; k <= Q; ++k) {
      result.si[i][k] = coefficient(path.parameters, static_cast<Eigen::Index>(i), k);
    }
  }
  parameters.to_si(std::span<Series<Real, Q>>(result.si));
  result.variable = result.si[static_cast<std::size_t>(variable)];
  return result;
}

/// Coefficients of the polynomial along the path up to h^order, without trailing zeros.
template <class Real, int Q>
auto evaluate(const MatrixPolynomial& polynomial, Eigen::Index rows, Eigen::Index columns,
              const ParameterSeries<Series<Real, Q>>& parameters, int order, bool& finite) {
  using std::isfinite;
  using Scalar = Series<Real, Q>;
  using Coefficient = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  // only as many coefficients as are nonzero: zero matrices would cost as much as others
  std::size_t count = 1;
  const auto look_at = [&](const Scalar& factor) {
    for (int k = 0; k <= order; ++k) {
      finite = finite && isfinite(factor[k]);
      if (factor[k] != Real(0.0)) count = std::max(count, static_cast<std::size_t>(k) + 1);
    }
  };
  std::vector<Scalar> powers, values;
  for (std::size_t j = 0; j < polynomial.coefficients.size(); ++j) {
    powers.push_back(j == 0 ? Scalar(1.0) : powers.back() * parameters.variable);
    look_at(powers.back());
  }
  for (const MatrixPolynomial::Entry& entry : polynomial.entries) {
    values.push_back(entry.expression.evaluate(std::span<const Scalar>(parameters.si)) *
                     powers[static_cast<std::size_t>(entry.power)]);
    look_at(values.back());
  }
  std::vector<Coefficient> result(count, Coefficient::Zero(rows, columns));
  for (std::size_t k = 0; k < count; ++k) {
    const auto at = static_cast<int>(k);
    for (std::size_t j = 0; j < powers.size(); ++j) {
      if (powers[j][at] != Real(0.0))
        result[k] += powers[j][at] * polynomial.coefficients[j].template cast<Real>();
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      const MatrixPolynomial::Entry& entry = polynomial.entries[i];
      result[k](entry.row, entry.column) += values[i][at];
    }
  }
  while (result.size() > 1 && result.back().isZero(Real(0.0))) result.pop_back();
  return typename BasicLinearization<Real>::Coefficients(std::make_move_iterator(result.begin()),
                                                         std::make_move_iterator(result.end()));
}

enum class Symmetry { symmetric, skew, none };

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

/// Symmetry of all coefficients. An entry that is an expression needs its counterpart across the diagonal.
Symmetry symmetry(const MatrixPolynomial& polynomial, const Parameters& parameters) {
  bool symmetric = true;
  bool skew = true;
  for (const Matrix& c : polynomial.coefficients) {
    symmetric = symmetric && c == c.transpose();
    skew = skew && c == -c.transpose();
  }
  const std::vector<Vector> places = places_to_compare(parameters);
  std::map<std::array<Eigen::Index, 3>, const Expression*> entries;
  for (const MatrixPolynomial::Entry& entry : polynomial.entries)
    entries[{entry.power, entry.row, entry.column}] = &entry.expression;
  for (const auto& [at, expression] : entries) {
    const auto across = entries.find({at[0], at[2], at[1]});
    const bool found = across != entries.end();
    symmetric = symmetric && found && agree(*expression, *across->second, 1.0, places);
    skew = skew && found && agree(*expression, *across->second, -1.0, places);
    if (!symmetric && !skew) break;
  }
  return symmetric ? Symmetry::symmetric : skew ? Symmetry::skew : Symmetry::none;
}

}  // namespace

MatrixFamily::MatrixFamily(ModelDescription description, int variable, MatrixPolynomial M, MatrixPolynomial C,
                           MatrixPolynomial K, MatrixPolynomial A, FamilyForm form)
    : Model([&] {
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
        const Symmetry c = C.empty() ? Symmetry::symmetric : symmetry(C, description.parameters);
        const bool k_symmetric = symmetry(K, description.parameters) == Symmetry::symmetric;
        description.effects = {
            {"M", "mass matrix, polynomial in the traced parameter", count(M), {.inertia = true}},
            {"C",
             "damping and gyroscopic matrix",
             count(C),
             {.dissipative = c != Symmetry::skew, .gyroscopic = c != Symmetry::symmetric}},
            {"K", "stiffness matrix", count(K), {.conservative = true, .circulatory = !k_symmetric}},
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

Vector MatrixFamily::initial_guess(const Vector&) const {
  return Vector::Zero(n_coordinates());
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
  Structure result;
  for (const Effect& effect : description().effects) {
    if (effect.count == 0) continue;
    result.damped = result.damped || effect.contribution.dissipative;
    result.gyroscopic = result.gyroscopic || effect.contribution.gyroscopic;
    result.circulatory = result.circulatory || effect.contribution.circulatory;
  }
  result.symmetric_mass = symmetry(M_, description().parameters) == Symmetry::symmetric;
  result.constant_mass = constant(M_, traced_parameter);
  result.constant_damping = constant(C_, traced_parameter);
  result.constant_stiffness = constant(K_, traced_parameter);
  result.constant_constraints = constant(A_, traced_parameter);
  result.fixed_equilibrium = true;
  result.known_equilibrium = true;
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

EvaluationFault MatrixFamily::residual(const Path& path, int order, SteadyResidual& result,
                                       EvaluationCounts&) const {
  // x = 0 and lambda = 0 solve A^T lambda + K x = 0, A x = 0 for all parameters.
  if (!path.x.isZero(0.0) || !path.lambda.isZero(0.0)) {
    throw std::invalid_argument("MatrixFamily: expected the equilibrium x = 0, lambda = 0");
  }
  result.force = VectorSeries::Zero(n_coordinates(), order + 1);
  result.constraint = VectorSeries::Zero(n_constraints(), order + 1);
  return {};
}

template <class Real, int Q>
EvaluationFault MatrixFamily::evaluate_all(const BasicPath<Real>& path, int order,
                                           BasicLinearization<Real>& result, EvaluationCounts& counts) const {
  const auto parameters = parameter_series<Real, Q>(description().parameters, variable_, path);
  const Eigen::Index n = n_coordinates();
  EvaluationFault fault;
  std::size_t effect = 0;
  const auto evaluate_one = [&](const MatrixPolynomial& polynomial, Eigen::Index rows, const char* name) {
    bool finite = true;
    auto series = evaluate<Real, Q>(polynomial, rows, n, parameters, order, finite);
    if (!finite && !fault) fault.source = name;
    if (!polynomial.empty()) ++counts.linearization[effect];
    ++effect;
    return series;
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

EvaluationFault MatrixFamily::extended_residual(const BasicPath<Extended>&,
                                                BasicSteadyResidual<Extended>& result) const {
  result.force = ExtendedMatrix::Zero(n_coordinates(), 1);
  result.constraint = ExtendedMatrix::Zero(n_constraints(), 1);
  return {};
}

EvaluationFault MatrixFamily::extended_linearization(const BasicPath<Extended>& path,
                                                     BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return evaluate_all<Extended, 0>(path, 0, result, counts);
}

}  // namespace eigentrail
