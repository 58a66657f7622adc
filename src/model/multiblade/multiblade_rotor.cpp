#include "model/multiblade/multiblade_rotor.hpp"

#include <algorithm>
#include <cmath>

#include "model/multiblade/matrix_sums.hpp"
#include "model/multibody.hpp"

namespace eigentrail {
namespace {

/// Distance from the axis over the size of the rotor, and sine of the inclination, up to which the hub counts
/// as being on the axis.
constexpr double still_on_axis = 1e-9;

using SharesByHarmonic = std::vector<std::vector<std::vector<RotorShare>>>;

/// Calls visit(row, column, value) for every entry that is not zero.
template <class Real, class Visit>
void for_each_entry(const BasicSystemMatrix<Real>& B, Visit visit) {
  if (B.is_sparse()) {
    const auto& values = B.sparse();
    for (Eigen::Index j = 0; j < values.outerSize(); ++j) {
      for (typename BasicSystemMatrix<Real>::Sparse::InnerIterator entry(values, j); entry; ++entry)
        visit(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(entry.col()), entry.value());
    }
    return;
  }
  B.visit([&](const auto& values) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      for (Eigen::Index i = 0; i < values.rows(); ++i) {
        const Real value = values.coeff(i, j);
        if (value != Real(0.0)) visit(static_cast<std::size_t>(i), static_cast<std::size_t>(j), value);
      }
    }
  });
}

/// The rotor at a path, as series up to h^order.
template <class Real>
class RotorAssembly {
 public:
  using Columns = typename BasicPath<Real>::Columns;
  using LongSeries = Series<Real, max_order>;

  RotorAssembly(const BladedRotorData& data, const SharesByHarmonic& shares, const BasicPath<Real>& path,
                int order)
      : data_(data),
        map_(data.map),
        shares_(shares),
        path_(path),
        order_(order),
        parameters_(parameters_of(data, path, order)) {
    std::vector<LongSeries> values(static_cast<std::size_t>(parameters_.rows()));
    for (Eigen::Index i = 0; i < parameters_.rows(); ++i) {
      for (int k = 0; k <= order; ++k) values[static_cast<std::size_t>(i)][k] = parameters_(i, k);
    }
    data.blade.data().parameters.to_si(std::span<LongSeries>(values));
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
    BasicSteadyResidual<Real> part;
    if (auto fault = data_.support.residual(support_path(), order_, part, counts)) return fault;
    for (std::size_t i = 0; i < map_.support.size(); ++i) {
      if (map_.support[i] >= 0) result.force.row(map_.support[i]) += part.force.row(row_of(i));
    }
    for (std::size_t i = 0; i < map_.support_row.size(); ++i) {
      if (map_.support_row[i] >= 0)
        result.constraint.row(map_.support_row[i]) = part.constraint.row(row_of(i));
    }
    add_conditions(data_.trims_of_support, part.constraint, result.constraint);
    if (auto fault = data_.blade.residual(blade_path(), order_, part, counts)) return fault;
    const Real n(map_.n_blades);
    for (std::size_t i = 0; i < map_.blade.size(); ++i) {
      for (const RotorShare& share : shares_[0][i])
        result.force.row(share.coordinate) += n * Real(share.weight) * part.force.row(row_of(i));
    }
    for (std::size_t i = 0; i < map_.blade_row.size(); ++i) {
      if (map_.blade_row[i] >= 0)
        result.constraint.row(map_.blade_row[i]) = n * part.constraint.row(row_of(i));
    }
    add_conditions(data_.trims_of_blade, part.constraint, result.constraint);
    return {};
  }

  EvaluationFault linearize(BasicLinearization<Real>& result, EvaluationCounts& counts) const {
    if (EvaluationFault fault = check_axis()) return fault;
    LinearizationSums<Real> sum(map_.n_coordinates, map_.n_constraints, order_);
    BasicLinearization<Real> part;
    if (auto fault = data_.support.linearize(support_path(), order_, part, counts)) return fault;
    add_support(part, sum);
    if (auto fault = data_.blade.linearize(blade_path(), order_, part, counts)) return fault;
    add_blades(part, sum);
    result = sum.take();
    return {};
  }

  /// As Assembly::trim_rows.
  EvaluationFault trim_rows(TrimDerivatives& result, EvaluationCounts& counts) const {
    result.x = Matrix::Zero(n_trims(), map_.n_coordinates);
    result.lambda = Matrix::Zero(n_trims(), map_.n_constraints);
    TrimDerivatives part;
    if (auto fault = data_.support.trim_rows(support_path(), part, counts)) return fault;
    for (std::size_t j = 0; j < data_.trims_of_support.size(); ++j) {
      const Eigen::Index row = data_.trims_of_support[j];
      for (std::size_t i = 0; i < map_.support.size(); ++i) {
        if (map_.support[i] >= 0) result.x(row, map_.support[i]) = part.x(row_of(j), row_of(i));
      }
      for (std::size_t i = 0; i < map_.support_row.size(); ++i) {
        if (map_.support_row[i] >= 0)
          result.lambda(row, map_.support_row[i]) = part.lambda(row_of(j), row_of(i));
      }
    }
    if (auto fault = data_.blade.trim_rows(blade_path(), part, counts)) return fault;
    for (std::size_t j = 0; j < data_.trims_of_blade.size(); ++j) {
      const Eigen::Index row = data_.trims_of_blade[j];
      for (std::size_t i = 0; i < map_.blade.size(); ++i) {
        for (const RotorShare& share : shares_[0][i])
          result.x(row, share.coordinate) += share.weight * part.x(row_of(j), row_of(i));
      }
      for (std::size_t i = 0; i < map_.blade_row.size(); ++i) {
        if (map_.blade_row[i] >= 0) result.lambda(row, map_.blade_row[i]) = part.lambda(row_of(j), row_of(i));
      }
    }
    return {};
  }

 private:
  using Coefficients = typename BasicLinearization<Real>::Coefficients;

  /// The parameters along the path, with the trimmed ones in their places.
  static Columns parameters_of(const BladedRotorData& data, const BasicPath<Real>& path, int order) {
    Columns all = Columns::Zero(path.parameters.rows(), order + 1);
    for (int k = 0; k <= order; ++k) {
      for (Eigen::Index i = 0; i < all.rows(); ++i) all(i, k) = coefficient(path.parameters, i, k);
      for (auto [part, rows] :
           {std::pair(&data.blade, &data.trims_of_blade), std::pair(&data.support, &data.trims_of_support)}) {
        for (std::size_t i = 0; i < rows->size(); ++i)
          all(part->data().trims[i].parameter, k) =
              coefficient(path.lambda, data.map.n_constraints + (*rows)[i], k);
      }
    }
    return all;
  }

  Eigen::Index n_trims() const { return path_.lambda.rows() - map_.n_constraints; }

  /// Puts the conditions of a part, the last rows of its constraints, in their places among the rotor's.
  void add_conditions(const std::vector<int>& trims, const Columns& part, Columns& constraint) const {
    const Eigen::Index first = part.rows() - row_of(trims.size());
    for (std::size_t i = 0; i < trims.size(); ++i)
      constraint.row(map_.n_constraints + trims[i]) = part.row(first + row_of(i));
  }

  static Eigen::Index row_of(std::size_t i) { return static_cast<Eigen::Index>(i); }

  /// The path of a part with these trims; coordinates and multipliers are zero.
  BasicPath<Real> empty_path(const std::vector<int>& trims) const {
    const Eigen::Index n = row_of(map_.support.size());
    const Eigen::Index m = row_of(map_.support_row.size());
    BasicPath<Real> part{parameters_, Columns::Zero(n, path_.x.cols()),
                         Columns::Zero(m + row_of(trims.size()), path_.lambda.cols())};
    for (std::size_t i = 0; i < trims.size(); ++i)
      part.lambda.row(m + row_of(i)) = path_.lambda.row(map_.n_constraints + trims[i]);
    return part;
  }

  BasicPath<Real> support_path() const {
    BasicPath<Real> part = empty_path(data_.trims_of_support);
    for (std::size_t i = 0; i < map_.support.size(); ++i) {
      if (map_.support[i] >= 0) part.x.row(row_of(i)) = path_.x.row(map_.support[i]);
    }
    for (std::size_t i = 0; i < map_.support_row.size(); ++i) {
      if (map_.support_row[i] >= 0) part.lambda.row(row_of(i)) = path_.lambda.row(map_.support_row[i]);
    }
    return part;
  }

  /// One blade, and the hub as it sees it, in the steady state.
  BasicPath<Real> blade_path() const {
    BasicPath<Real> part = empty_path(data_.trims_of_blade);
    for (std::size_t i = 0; i < map_.blade.size(); ++i) {
      for (const RotorShare& share : shares_[0][i])
        part.x.row(row_of(i)) += Real(share.weight) * path_.x.row(share.coordinate);
    }
    for (std::size_t i = 0; i < map_.blade_row.size(); ++i) {
      if (map_.blade_row[i] >= 0) part.lambda.row(row_of(i)) = path_.lambda.row(map_.blade_row[i]);
    }
    return part;
  }

  void add_support(const BasicLinearization<Real>& part, LinearizationSums<Real>& sum) const {
    for (const auto& [from, to] :
         {std::pair(&part.M, &sum.M), std::pair(&part.C, &sum.C), std::pair(&part.K, &sum.K)}) {
      for (std::size_t k = 0; k < from->size(); ++k) {
        for_each_entry((*from)[k], [&, to = to](std::size_t i, std::size_t j, const Real& value) {
          to->add(k, map_.support[i], map_.support[j], value);
        });
      }
    }
    for (std::size_t k = 0; k < part.A.size(); ++k) {
      for_each_entry(part.A[k], [&](std::size_t i, std::size_t j, const Real& value) {
        sum.A.add(k, map_.support_row[i], map_.support[j], value);
      });
    }
  }

  void add_blades(const BasicLinearization<Real>& blade, LinearizationSums<Real>& sum) const {
    const LongSeries one(1.0), twice = 2.0 * speed_, squared = speed_ * speed_;
    fold(blade.M, one, 0, sum.M);
    fold(blade.C, one, 0, sum.C);
    fold(blade.M, twice, 1, sum.C);
    fold(blade.K, one, 0, sum.K);
    fold(blade.C, speed_, 1, sum.K);
    fold(blade.M, squared, 2, sum.K);
    for (std::size_t a = 0; a < map_.harmonics.size(); ++a) {
      const Real weight(map_.n_blades * map_.harmonics[a].mean_square);
      for (std::size_t k = 0; k < blade.A.size(); ++k) {
        for_each_entry(blade.A[k], [&](std::size_t i, std::size_t j, const Real& value) {
          for (const RotorShare& share : shares_[a][j])
            sum.A.add(k, map_.blade_row[i] + static_cast<int>(a), share.coordinate,
                      weight * Real(share.weight) * value);
        });
      }
    }
  }

  /// Adds N sum_a w_a G_a^T (factor B) (D^d G)_a, d = `derivative`.
  void fold(const Coefficients& B, const LongSeries& factor, int derivative, MatrixSum<Real>& sum) const {
    for (std::size_t a = 0; a < map_.harmonics.size(); ++a) {
      const Harmonic& harmonic = map_.harmonics[a];
      if (derivative > 0 && harmonic.partner < 0) continue;
      std::size_t columns = a;
      double scale = map_.n_blades * harmonic.mean_square;
      if (derivative == 1) {
        columns = static_cast<std::size_t>(harmonic.partner);
        scale *= map_.harmonics[columns].slope;
      } else if (derivative == 2) {
        scale *= -harmonic.number * harmonic.number;
      }
      for (std::size_t k = 0; k < B.size(); ++k) {
        for_each_entry(B[k], [&](std::size_t i, std::size_t j, const Real& value) {
          for (const RotorShare& row : shares_[a][i]) {
            for (const RotorShare& column : shares_[columns][j]) {
              const Real entry = Real(scale * row.weight * column.weight) * value;
              for (int l = 0; static_cast<int>(k) + l <= order_; ++l) {
                if (factor[l] != Real(0.0))
                  sum.add(k + static_cast<std::size_t>(l), row.coordinate, column.coordinate,
                          factor[l] * entry);
              }
            }
          }
        });
      }
    }
  }

  const BladedRotorData& data_;
  const MultibladeMap& map_;
  const SharesByHarmonic& shares_;
  const BasicPath<Real>& path_;
  int order_;
  Columns parameters_;  ///< with trimmed parameters
  LongSeries speed_;
};

}  // namespace

MultibladeRotor::MultibladeRotor(ModelDescription description, BladedRotorData data)
    : Model(with_costs(std::move(description), {&data.blade.equations(), &data.support.equations()})),
      data_(std::move(data)) {
  for (std::size_t a = 0; a < data_.map.harmonics.size(); ++a) shares_.push_back(data_.map.shares(a));
}

Vector MultibladeRotor::initial_guess(const Vector& parameters) const {
  Vector si = parameters;
  data_.blade.data().parameters.to_si(std::span<double>(si.data(), static_cast<std::size_t>(si.size())));
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
  const Parameters& parameters = data_.blade.data().parameters;
  const bool same_speed = std::none_of(moving.begin(), moving.end(), [&](int parameter) {
    return parameters.depends_on(data_.speed, parameter);
  });
  Structure result = structure_of({&data_.blade, &data_.support}, moving);
  result.gyroscopic = true;
  // The damping of blades acts in the turning frame: Omega C (DG) is unsymmetric.
  result.circulatory = result.circulatory || structure_of({&data_.blade}, moving).damped;
  result.constant_damping = result.constant_damping && result.constant_mass && same_speed;
  result.constant_stiffness = result.constant_stiffness && result.constant_damping;
  return result;
}

EvaluationFault MultibladeRotor::residual(const Path& path, int order, SteadyResidual& result,
                                          EvaluationCounts& counts) const {
  return RotorAssembly<double>(data_, shares_, path, order).residual(result, counts);
}

EvaluationFault MultibladeRotor::linearize(const Path& path, int order, Linearization& result,
                                           EvaluationCounts& counts) const {
  return RotorAssembly<double>(data_, shares_, path, order).linearize(result, counts);
}

EvaluationFault MultibladeRotor::trim_derivatives(const Path& at, TrimDerivatives& result,
                                                  EvaluationCounts& counts) const {
  if (auto fault = differentiate_by_unknowns(*this, at, result, counts)) return fault;
  return RotorAssembly<double>(data_, shares_, at, 0).trim_rows(result, counts);
}

std::vector<Expression> MultibladeRotor::expressions() const {
  return varying(data_.blade.data().quantities);
}

EvaluationFault MultibladeRotor::extended_residual(const BasicPath<Extended>& path,
                                                   BasicSteadyResidual<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return RotorAssembly<Extended>(data_, shares_, path, 0).residual(result, counts);
}

EvaluationFault MultibladeRotor::extended_linearization(const BasicPath<Extended>& path,
                                                        BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return RotorAssembly<Extended>(data_, shares_, path, 0).linearize(result, counts);
}

}  // namespace eigentrail
