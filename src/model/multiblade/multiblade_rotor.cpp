#include "model/multiblade/multiblade_rotor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/multibody.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {
namespace {

/// Distance from the axis over the size of the rotor, and sine of the inclination, up to which the hub counts
/// as being on the axis.
constexpr double still_on_axis = 1e-9;

/// The rotor at a path, as series up to h^order.
template <class Real>
class RotorAssembly {
 public:
  using Columns = typename BasicPath<Real>::Columns;
  using LongSeries = Series<Real, max_order>;

  RotorAssembly(const BladedRotorData& data, const BasicPath<Real>& path, int order)
      : data_(data),
        map_(data.map),
        path_(path),
        order_(order),
        parameters_(parameters_of(data, path, order)) {
    std::vector<LongSeries> values(static_cast<std::size_t>(parameters_.rows()));
    for (Eigen::Index i = 0; i < parameters_.rows(); ++i) {
      for (int k = 0; k <= order; ++k) values[static_cast<std::size_t>(i)][k] = parameters_(i, k);
    }
    data.blade.assembly.data().parameters.to_si(std::span<LongSeries>(values));
    speed_ = data.speed.evaluate(std::span<const LongSeries>(values));
  }

  /// A fault if the hub is not on the axis of rotation, or blades differ.
  EvaluationFault check_axis() const {
    using std::abs;
    const auto at = [&](int i) {
      const int own = map_.support[static_cast<std::size_t>(map_.hub_coordinate + i)];
      return static_cast<double>(abs(path_.x(own, 0)));
    };
    double size = 0.0;
    for (Eigen::Index i = 0; i < path_.x.rows(); ++i)
      size = std::max(size, static_cast<double>(abs(path_.x(i, 0))));
    const double away = std::max(at(0), at(1));
    const double inclined = std::max(at(9), at(10));  // components of its z axis across that of rotation
    if (away <= still_on_axis * size && inclined <= still_on_axis) return {};
    return {data_.hub,
            "the hub '" + data_.hub + "' " + (away > still_on_axis * size ? "leaves" : "is inclined to") +
                " the axis of rotation under a steady load across it, and the equations keep "
                "coefficients that change with the azimuth; hold it on the z axis, or balance the load "
                "of its support"};
  }

  EvaluationFault residual(BasicSteadyResidual<Real>& result, EvaluationCounts& counts) const {
    if (EvaluationFault fault = check_axis()) return fault;
    result.force = Columns::Zero(map_.n_coordinates, order_ + 1);
    result.constraint = Columns::Zero(path_.lambda.rows(), order_ + 1);
    for (const RotorPart* part : parts()) {
      BasicSteadyResidual<Real> own;
      if (auto fault = part->assembly.residual(path_of(*part), order_, own, counts)) return fault;
      const Real n(part->count);
      result.force += n * (coordinates(*part).transpose() * own.force);
      const Eigen::Index first = own.constraint.rows() - row_of(part->trims.size());
      result.constraint.topRows(map_.n_constraints) +=
          n * (multipliers(*part).transpose() * own.constraint.topRows(first));
      // The conditions of a part, the last rows of its constraints.
      for (std::size_t i = 0; i < part->trims.size(); ++i)
        result.constraint.row(map_.n_constraints + part->trims[i]) = own.constraint.row(first + row_of(i));
    }
    return {};
  }

  EvaluationFault linearize(BasicLinearization<Real>& result, EvaluationCounts& counts) const {
    if (EvaluationFault fault = check_axis()) return fault;
    const Eigen::Index n = map_.n_coordinates;
    Sum M(n, n, order_), C(n, n, order_), K(n, n, order_), A(map_.n_constraints, n, order_);
    const LongSeries one(1.0), twice = 2.0 * speed_, squared = speed_ * speed_;
    for (const RotorPart* part : parts()) {
      BasicLinearization<Real> own;
      if (auto fault = part->assembly.linearize(path_of(*part), order_, own, counts)) return fault;
      for (std::size_t a = 0; a < part->harmonics.size(); ++a) {
        const Harmonic& harmonic = part->harmonics[a];
        const Real weight(part->count * harmonic.mean_square);
        const Sparse G = coordinates(*part, a), weighted = weight * G;
        add(M, one, weighted, own.M, G);
        add(C, one, weighted, own.C, G);
        add(K, one, weighted, own.K, G);
        add(A, one, weight * multipliers(*part, a), own.A, G);
        if (harmonic.partner < 0) continue;
        const auto partner = static_cast<std::size_t>(harmonic.partner);
        const Sparse DG = Real(part->harmonics[partner].slope) * coordinates(*part, partner);
        const Sparse D2G = Real(-harmonic.number * harmonic.number) * G;
        add(C, twice, weighted, own.M, DG);
        add(K, speed_, weighted, own.C, DG);
        add(K, squared, weighted, own.M, D2G);
      }
    }
    result = {M.take(), C.take(), K.take(), A.take()};
    for (auto* list : {&result.M, &result.C, &result.K, &result.A}) {
      for (auto& one_of_list : *list) {
        if (n < sparse_from) one_of_list = one_of_list.dense();
      }
    }
    return {};
  }

  /// As Assembly::trim_rows.
  EvaluationFault trim_rows(TrimDerivatives& result, EvaluationCounts& counts) const {
    result.x = Matrix::Zero(n_trims(), map_.n_coordinates);
    result.lambda = Matrix::Zero(n_trims(), map_.n_constraints);
    for (const RotorPart* part : parts()) {
      TrimDerivatives own;
      if (auto fault = part->assembly.trim_rows(path_of(*part), own, counts)) return fault;
      const Matrix x = own.x * part->coordinates[0], lambda = own.lambda * part->multipliers[0];
      for (std::size_t j = 0; j < part->trims.size(); ++j) {
        result.x.row(part->trims[j]) = x.row(row_of(j));
        result.lambda.row(part->trims[j]) = lambda.row(row_of(j));
      }
    }
    return {};
  }

 private:
  using Coefficients = typename BasicLinearization<Real>::Coefficients;
  using Sparse = typename BasicSystemMatrix<Real>::Sparse;
  using Sum = SeriesSum<Sparse, max_order>;

  std::array<const RotorPart*, 2> parts() const { return {&data_.support, &data_.blade}; }

  static Sparse coordinates(const RotorPart& part, std::size_t harmonic = 0) {
    return part.coordinates[harmonic].template cast<Real>();
  }
  static Sparse multipliers(const RotorPart& part, std::size_t harmonic = 0) {
    return part.multipliers[harmonic].template cast<Real>();
  }

  /// The parameters along the path, with the trimmed ones in their places.
  static Columns parameters_of(const BladedRotorData& data, const BasicPath<Real>& path, int order) {
    Columns all = Columns::Zero(path.parameters.rows(), order + 1);
    for (int k = 0; k <= order; ++k) {
      for (Eigen::Index i = 0; i < all.rows(); ++i) all(i, k) = coefficient(path.parameters, i, k);
      for (const RotorPart* part : {&data.blade, &data.support}) {
        for (std::size_t i = 0; i < part->trims.size(); ++i)
          all(part->assembly.data().trims[i].parameter, k) =
              coefficient(path.lambda, data.map.n_constraints + part->trims[i], k);
      }
    }
    return all;
  }

  Eigen::Index n_trims() const { return path_.lambda.rows() - map_.n_constraints; }

  static Eigen::Index row_of(std::size_t i) { return static_cast<Eigen::Index>(i); }

  /// The support, or one blade and the hub as it sees it, in the steady state.
  BasicPath<Real> path_of(const RotorPart& part) const {
    const Columns lambda = multipliers(part) * path_.lambda.topRows(map_.n_constraints);
    BasicPath<Real> own{parameters_, coordinates(part) * path_.x,
                        Columns::Zero(lambda.rows() + row_of(part.trims.size()), lambda.cols())};
    own.lambda.topRows(lambda.rows()) = lambda;
    for (std::size_t i = 0; i < part.trims.size(); ++i)
      own.lambda.row(lambda.rows() + row_of(i)) = path_.lambda.row(map_.n_constraints + part.trims[i]);
    return own;
  }

  /// Adds factor (left^T B right).
  void add(Sum& sum, const LongSeries& factor, const Sparse& left, const Coefficients& B,
           const Sparse& right) const {
    for (std::size_t k = 0; k < B.size(); ++k) {
      const Sparse inner = B[k].is_sparse() ? B[k].sparse() : Sparse(B[k].dense().sparseView());
      LongSeries later(0.0);
      for (std::size_t l = k; l <= static_cast<std::size_t>(order_); ++l)
        later[static_cast<int>(l)] = factor[static_cast<int>(l - k)];
      sum.add(later, Sparse(left.transpose() * inner * right));
    }
  }

  const BladedRotorData& data_;
  const MultibladeMap& map_;
  const BasicPath<Real>& path_;
  int order_;
  Columns parameters_;  ///< with trimmed parameters
  LongSeries speed_;
};

}  // namespace

MultibladeRotor::MultibladeRotor(ModelDescription description, BladedRotorData data)
    : Model(with_costs(std::move(description),
                       {&data.blade.assembly.equations(), &data.support.assembly.equations()})),
      data_(std::move(data)) {}

Vector MultibladeRotor::initial_guess(const Vector& parameters) const {
  Vector si = parameters;
  data_.blade.assembly.data().parameters.to_si(
      std::span<double>(si.data(), static_cast<std::size_t>(si.size())));
  const std::span<const double> values(si.data(), static_cast<std::size_t>(si.size()));
  Vector x = Vector::Zero(n_coordinates());
  for (std::size_t i = 0; i < data_.guess.size(); ++i) {
    const int blade = data_.map.blade[i];
    x[blade >= 0 ? blade : data_.map.support[i]] = data_.guess[i].evaluate(values);
  }
  settle_states(*this, data_.n_states, parameters, x);
  return x;
}

Structure MultibladeRotor::structure(int traced_parameter) const {
  const std::vector<int> moving = moving_parameters(description(), traced_parameter);
  const Parameters& parameters = data_.blade.assembly.data().parameters;
  const bool same_speed = std::none_of(moving.begin(), moving.end(), [&](int parameter) {
    return parameters.depends_on(data_.speed, parameter);
  });
  Structure result = structure_of({&data_.blade.assembly, &data_.support.assembly}, moving);
  result.gyroscopic = true;
  // The damping of blades acts in the turning frame: Omega C (DG) is unsymmetric.
  result.circulatory = result.circulatory || structure_of({&data_.blade.assembly}, moving).damped;
  result.constant_damping = result.constant_damping && result.constant_mass && same_speed;
  result.constant_stiffness = result.constant_stiffness && result.constant_damping;
  return result;
}

EvaluationFault MultibladeRotor::residual(const Path& path, int order, SteadyResidual& result,
                                          EvaluationCounts& counts) const {
  return RotorAssembly<double>(data_, path, order).residual(result, counts);
}

EvaluationFault MultibladeRotor::linearize(const Path& path, int order, Linearization& result,
                                           EvaluationCounts& counts) const {
  return RotorAssembly<double>(data_, path, order).linearize(result, counts);
}

EvaluationFault MultibladeRotor::trim_derivatives(const Path& at, TrimDerivatives& result,
                                                  EvaluationCounts& counts) const {
  if (auto fault = differentiate_by_unknowns(*this, at, result, counts)) return fault;
  return RotorAssembly<double>(data_, at, 0).trim_rows(result, counts);
}

std::vector<Expression> MultibladeRotor::expressions() const {
  return varying(data_.blade.assembly.data().quantities);
}

EvaluationFault MultibladeRotor::extended_residual(const BasicPath<Extended>& path,
                                                   BasicSteadyResidual<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return RotorAssembly<Extended>(data_, path, 0).residual(result, counts);
}

EvaluationFault MultibladeRotor::extended_linearization(const BasicPath<Extended>& path,
                                                        BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return RotorAssembly<Extended>(data_, path, 0).linearize(result, counts);
}

}  // namespace eigentrail
