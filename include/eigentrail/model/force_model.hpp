// A model defined by the user: generalized coordinates x with a mass matrix and a force,
//
//   M(x, p) x'' = f(x, x', p)                                  (seed paper, Eq. 3a without constraints)
//
// `Physics` is a class that defines M and f once, as templates over the scalar type. C = -f_/x', K = -f_/x
// and all derivatives along the path follow by automatic differentiation. docs/cpp.md has an example.
#pragma once

#include <string>
#include <utility>

#include "eigentrail/core/series.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// State at which the physics is evaluated: n coordinates, their rates, and the parameters in SI units by
/// index.
template <class Scalar, int n>
struct GeneralizedState {
  Eigen::Matrix<Scalar, n, 1> x;
  Eigen::Matrix<Scalar, n, 1> rate;
  std::vector<Scalar> p;
};

template <class Scalar, int n>
using GeneralizedForce = Eigen::Matrix<Scalar, n, 1>;
template <class Scalar, int n>
using GeneralizedMass = Eigen::Matrix<Scalar, n, n>;

/// Model with the mass matrix and force of `Physics`, a class that is copyable and safe to call from several
/// threads and has
///
///   static constexpr int freedoms = n;
///   static constexpr Contribution contribution{...};   parts of f; if absent, f may have all of them
///   template <class Scalar> GeneralizedMass<Scalar, n> mass(const GeneralizedState<Scalar, n>&) const;
///   template <class Scalar> GeneralizedForce<Scalar, n> force(const GeneralizedState<Scalar, n>&) const;
///
/// M must be symmetric. Functions of scalars must be called without std:: (using std::sin; sin(x)). A
/// linearization costs 2 n evaluations of the force. f may only have the parts that the contribution names.
template <class Physics>
class ForceModel final : public Model {
 public:
  static constexpr int n = Physics::freedoms;

  /// `names` (n) label the coordinates in messages and files; `guess` (n) is the starting guess of the
  /// equilibrium at the beginning of a trace. Throws std::invalid_argument if the sizes differ from n.
  ForceModel(Physics physics, Parameters parameters, std::vector<std::string> names, Vector guess)
      : Model(describe(std::move(parameters), std::move(names))),
        physics_(std::move(physics)),
        guess_(std::move(guess)) {
    if (guess_.size() != n || n_coordinates() != n)
      throw std::invalid_argument("ForceModel: expected " + std::to_string(n) +
                                  " coordinates, found names of " + std::to_string(n_coordinates()) +
                                  " and a guess of " + std::to_string(guess_.size()));
  }

  Vector initial_guess(const Vector&) const override { return guess_; }

  Structure structure(int) const override {
    Structure structure;
    structure.add(description().effects.front().contribution);
    return structure;
  }

  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override {
    ++counts.residual[0];
    return steady<double, max_order>(path, order, result);
  }
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override {
    counts.linearization[0] += 2 * n;
    return differentiate<double, max_order>(path, order, result);
  }
  EvaluationFault extended_residual(const BasicPath<Extended>& path,
                                    BasicSteadyResidual<Extended>& result) const override {
    return steady<Extended, 0>(path, 0, result);
  }
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override {
    return differentiate<Extended, 0>(path, 0, result);
  }

 private:
  static ModelDescription describe(Parameters parameters, std::vector<std::string> names) {
    Contribution parts{true, true, true, true, true, false};
    if constexpr (requires { Physics::contribution; }) parts = Physics::contribution;
    ModelDescription description;
    description.coordinate_units.assign(names.size(), "1");
    description.coordinate_names = std::move(names);
    description.effects = {{"force", "a model of the user's own", 1, parts, 2 * n}};
    description.parameters = std::move(parameters);
    return description;
  }

  /// The state at rest along the path, in any scalar that can hold a series along it.
  template <class Scalar, class Real, int Q>
  GeneralizedState<Scalar, n> at_rest(const BasicPath<Real>& path) const {
    const auto series_of = [](const auto& columns, Eigen::Index row) {
      Series<Real, Q> series;
      for (int k = 0; k <= Q; ++k) series[k] = coefficient(columns, row, k);
      return series;
    };
    std::vector<Series<Real, Q>> p;
    for (Eigen::Index i = 0; i < path.parameters.rows(); ++i) p.push_back(series_of(path.parameters, i));
    description().parameters.to_si(std::span<Series<Real, Q>>(p));
    GeneralizedState<Scalar, n> state;
    state.p.assign(p.begin(), p.end());
    for (int i = 0; i < n; ++i) {
      state.x[i] = Scalar(series_of(path.x, i));
      state.rate[i] = Scalar(0.0);
    }
    return state;
  }

  template <class Real, int Q>
  EvaluationFault steady(const BasicPath<Real>& path, int order, BasicSteadyResidual<Real>& result) const {
    using std::isfinite;
    using Scalar = Series<Real, Q>;
    const auto force = physics_.force(at_rest<Scalar, Real, Q>(path));
    result.force.resize(n, order + 1);
    result.constraint.resize(0, order + 1);
    bool finite = true;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= order; ++k) {
        result.force(i, k) = -force[i][k];
        finite = finite && isfinite(force[i][k]);
      }
    }
    return finite ? EvaluationFault{} : EvaluationFault{"the force"};
  }

  template <class Real, int Q>
  EvaluationFault differentiate(const BasicPath<Real>& path, int order,
                                BasicLinearization<Real>& result) const {
    using std::isfinite;
    using Base = Series<Real, Q>;
    using Dual = Series<Base, 1>;
    using Coefficient = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
    const auto size = static_cast<std::size_t>(order) + 1;
    std::vector<Coefficient> M(size, Coefficient::Zero(n, n)), C = M, K = M;
    bool finite = true;
    const auto keep = [&](std::vector<Coefficient>& matrix, int row, int column, const Base& value) {
      for (std::size_t k = 0; k < size; ++k) {
        matrix[k](row, column) = value[static_cast<int>(k)];
        finite = finite && isfinite(value[static_cast<int>(k)]);
      }
    };
    const GeneralizedMass<Base, n> mass = physics_.mass(at_rest<Base, Real, Q>(path));
    GeneralizedState<Dual, n> state = at_rest<Dual, Real, Q>(path);
    for (int j = 0; j < n; ++j) {
      for (auto [direction, matrix] : {std::pair(&state.x, &K), std::pair(&state.rate, &C)}) {
        (*direction)[j][1] = Base(1.0);
        const GeneralizedForce<Dual, n> force = physics_.force(state);
        (*direction)[j][1] = Base(0.0);
        for (int i = 0; i < n; ++i) keep(*matrix, i, j, -force[i][1]);
      }
      for (int i = 0; i < n; ++i) keep(M, i, j, mass(i, j));
    }
    result.M.assign(M.begin(), M.end());
    result.C.assign(C.begin(), C.end());
    result.K.assign(K.begin(), K.end());
    result.A.assign(1, Coefficient(Coefficient::Zero(0, n)));
    return finite ? EvaluationFault{} : EvaluationFault{"the force or the mass"};
  }

  Physics physics_;
  Vector guess_;
};

}  // namespace eigentrail
