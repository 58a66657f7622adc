#include "model/multiblade/multiblade_rotor.hpp"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Distance from the axis over the size of the rotor, and sine of the inclination, up to which the hub counts
/// as being on the axis.
constexpr double still_on_axis = 1e-9;

/// Sum of entries of a matrix whose coefficients are power series up to h^order.
template <class Real>
class MatrixSum {
 public:
  MatrixSum(int rows, int columns, int order)
      : rows_(rows), columns_(columns), entries_(static_cast<std::size_t>(order) + 1) {
    if (!sparse_) dense_.assign(entries_.size(), Dense::Zero(rows, columns));
  }

  /// Adds to the coefficient of h^k of an entry.
  void add(std::size_t k, int row, int column, const Real& value) {
    if (!sparse_)
      dense_[k](row, column) += value;
    else if (value != Real(0.0))
      entries_[k].emplace_back(row, column, value);
  }

  /// The sum without trailing coefficients that are exactly zero, so a constant has one coefficient. May be
  /// called once.
  typename BasicLinearization<Real>::Coefficients take() {
    typename BasicLinearization<Real>::Coefficients result;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (sparse_)
        result.emplace_back(sparse_sum(k));
      else
        result.emplace_back(std::move(dense_[k]));
    }
    while (result.size() > 1 && result.back().is_zero()) result.pop_back();
    return result;
  }

 private:
  using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Triplets = std::vector<Eigen::Triplet<Real>>;

  Eigen::SparseMatrix<Real> sparse_sum(std::size_t k) const {
    Eigen::SparseMatrix<Real> sum(rows_, columns_);
    sum.setFromTriplets(entries_[k].begin(), entries_[k].end());
    return sum;
  }

  Eigen::Index rows_, columns_;
  bool sparse_ = columns_ >= sparse_from;
  std::vector<Dense> dense_;
  std::vector<Triplets> entries_;
};

/// The sums of all four matrices of a linearization.
template <class Real>
struct LinearizationSums {
  MatrixSum<Real> M, C, K, A;
};

/// Calls visit(row, column, value) for every entry that is not zero.
template <class Real, class Visit>
void for_each_entry(const BasicSystemMatrix<Real>& B, Visit visit) {
  B.visit([&](const auto& values) {
    for (Eigen::Index j = 0; j < values.outerSize(); ++j) {
      for (Eigen::InnerIterator<std::decay_t<decltype(values)>> entry(values, j); entry; ++entry) {
        if (entry.value() != Real(0.0))
          visit(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(entry.col()), entry.value());
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

  RotorAssembly(const RotorEquations& data, const BasicPath<Real>& path, int order)
      : data_(data),
        map_(data.map),
        path_(path),
        order_(order),
        parameters_(parameters_of(data, path, order)) {
    std::vector<LongSeries> values(static_cast<std::size_t>(parameters_.rows()));
    for (Eigen::Index i = 0; i < parameters_.rows(); ++i) {
      for (int k = 0; k <= order; ++k) values[static_cast<std::size_t>(i)][k] = parameters_(i, k);
    }
    data.data().parameters.to_si(std::span<LongSeries>(values));
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
                " the axis of rotation under a steady load across it, and the equations keep coefficients "
                "that change with the azimuth; hold it on the z axis, or balance the load of its support"};
  }

  EvaluationFault residual(BasicSteadyResidual<Real>& result, EvaluationCounts& counts) const {
    if (EvaluationFault fault = check_axis()) return fault;
    result.force = Columns::Zero(map_.n_coordinates, order_ + 1);
    result.constraint = Columns::Zero(path_.lambda.rows(), order_ + 1);
    BasicSteadyResidual<Real> own;
    for (const RotorPart* part : {&data_.support, &data_.blade}) {
      if (auto fault = part->equations.residual(path_of(*part), order_, own, counts)) return fault;
      const Real count(part->count);
      for_each_share(*part, [&](Eigen::Index i, const RotorShare& share) {
        result.force.row(share.coordinate) += count * Real(share.weight) * own.force.row(i);
      });
      for_each_row(*part, [&](Eigen::Index i, int row) {
        result.constraint.row(row) = count * own.constraint.row(i);
      });
      // The conditions are the last rows.
      const Eigen::Index first = own.constraint.rows() - index(part->trims.size());
      for (std::size_t i = 0; i < part->trims.size(); ++i)
        result.constraint.row(map_.n_constraints + part->trims[i]) = own.constraint.row(first + index(i));
    }
    return {};
  }

  EvaluationFault linearize(BasicLinearization<Real>& result, EvaluationCounts& counts) const {
    if (EvaluationFault fault = check_axis()) return fault;
    const int n = map_.n_coordinates, m = map_.n_constraints;
    LinearizationSums<Real> sum{{n, n, order_}, {n, n, order_}, {n, n, order_}, {m, n, order_}};
    BasicLinearization<Real> own;
    for (const RotorPart* part : {&data_.support, &data_.blade}) {
      if (auto fault = part->equations.linearize(path_of(*part), order_, own, counts)) return fault;
      add(*part, own, sum);
    }
    result = {sum.M.take(), sum.C.take(), sum.K.take(), sum.A.take()};
    return {};
  }

  /// As Assembly::trim_rows.
  EvaluationFault trim_rows(TrimDerivatives& result, EvaluationCounts& counts) const {
    const Eigen::Index n_trims = path_.lambda.rows() - map_.n_constraints;
    result.x = Matrix::Zero(n_trims, map_.n_coordinates);
    result.lambda = Matrix::Zero(n_trims, map_.n_constraints);
    TrimDerivatives own;
    for (const RotorPart* part : {&data_.support, &data_.blade}) {
      if (auto fault = part->equations.trim_rows(path_of(*part), own, counts)) return fault;
      for (std::size_t j = 0; j < part->trims.size(); ++j) {
        const Eigen::Index trim = part->trims[j];
        for_each_share(*part, [&](Eigen::Index i, const RotorShare& share) {
          result.x(trim, share.coordinate) += share.weight * own.x(index(j), i);
        });
        for_each_row(*part,
                     [&](Eigen::Index i, int row) { result.lambda(trim, row) = own.lambda(index(j), i); });
      }
    }
    return {};
  }

 private:
  using Coefficients = typename BasicLinearization<Real>::Coefficients;

  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

  /// Calls visit(coordinate, share) for the entries of G in the steady state.
  static void for_each_share(const RotorPart& part, auto visit) {
    for (std::size_t i = 0; i < part.shares[0].size(); ++i) {
      for (const RotorShare& share : part.shares[0][i]) visit(index(i), share);
    }
  }
  /// Calls visit(row, row of the rotor) for the constraints of a part.
  static void for_each_row(const RotorPart& part, auto visit) {
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
      if (part.rows[i] >= 0) visit(index(i), part.rows[i]);
    }
  }

  /// The parameters along the path, with the trimmed ones in their places.
  static Columns parameters_of(const RotorEquations& data, const BasicPath<Real>& path, int order) {
    Columns all = Columns::Zero(path.parameters.rows(), order + 1);
    for (int k = 0; k <= order; ++k) {
      for (Eigen::Index i = 0; i < all.rows(); ++i) all(i, k) = coefficient(path.parameters, i, k);
      for (const RotorPart* part : {&data.blade, &data.support}) {
        for (std::size_t i = 0; i < part->trims.size(); ++i)
          all(part->equations.data().trims[i].parameter, k) =
              coefficient(path.lambda, data.map.n_constraints + part->trims[i], k);
      }
    }
    return all;
  }

  /// One part, and the hub as it sees it, in the steady state.
  BasicPath<Real> path_of(const RotorPart& part) const {
    const Eigen::Index m = index(part.rows.size());
    BasicPath<Real> own{parameters_, Columns::Zero(index(part.shares[0].size()), path_.x.cols()),
                        Columns::Zero(m + index(part.trims.size()), path_.lambda.cols())};
    for_each_share(part, [&](Eigen::Index i, const RotorShare& share) {
      own.x.row(i) += Real(share.weight) * path_.x.row(share.coordinate);
    });
    for_each_row(part, [&](Eigen::Index i, int row) { own.lambda.row(i) = path_.lambda.row(row); });
    for (std::size_t i = 0; i < part.trims.size(); ++i)
      own.lambda.row(m + index(i)) = path_.lambda.row(map_.n_constraints + part.trims[i]);
    return own;
  }

  void add(const RotorPart& part, const BasicLinearization<Real>& own, LinearizationSums<Real>& sum) const {
    const LongSeries one(1.0), twice = 2.0 * speed_, squared = speed_ * speed_;
    fold(part, own.M, one, 0, sum.M);
    fold(part, own.C, one, 0, sum.C);
    fold(part, own.M, twice, 1, sum.C);
    fold(part, own.K, one, 0, sum.K);
    fold(part, own.C, speed_, 1, sum.K);
    fold(part, own.M, squared, 2, sum.K);
    for (std::size_t a = 0; a < part.harmonics.size(); ++a) {
      const Real weight(part.count * part.harmonics[a].mean_square);
      for (std::size_t k = 0; k < own.A.size(); ++k) {
        for_each_entry(own.A[k], [&](std::size_t i, std::size_t j, const Real& value) {
          for (const RotorShare& share : part.shares[a][j])
            sum.A.add(k, part.rows[i] + static_cast<int>(a), share.coordinate,
                      weight * Real(share.weight) * value);
        });
      }
    }
  }

  /// Adds N sum_a w_a G_a^T (factor B) (D^d G)_a, d = `derivative`.
  void fold(const RotorPart& part, const Coefficients& B, const LongSeries& factor, int derivative,
            MatrixSum<Real>& sum) const {
    for (std::size_t a = 0; a < part.harmonics.size(); ++a) {
      const Harmonic& harmonic = part.harmonics[a];
      if (derivative > 0 && harmonic.partner < 0) continue;
      std::size_t columns = a;
      double scale = part.count * harmonic.mean_square;
      if (derivative == 1) {
        columns = static_cast<std::size_t>(harmonic.partner);
        scale *= part.harmonics[columns].slope;
      } else if (derivative == 2) {
        scale *= -harmonic.number * harmonic.number;
      }
      for (std::size_t k = 0; k < B.size(); ++k) {
        for_each_entry(B[k], [&](std::size_t i, std::size_t j, const Real& value) {
          for (const RotorShare& row : part.shares[a][i]) {
            for (const RotorShare& column : part.shares[columns][j]) {
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

  const RotorEquations& data_;
  const MultibladeMap& map_;
  const BasicPath<Real>& path_;
  int order_;
  Columns parameters_;  ///< with trimmed parameters
  LongSeries speed_;
};

}  // namespace

Eigen::Index RotorEquations::coordinate(std::size_t of_scene) const {
  return map.blade[of_scene] >= 0 ? map.blade[of_scene] : map.support[of_scene];
}

ModelDescription RotorEquations::with_costs(ModelDescription description) const {
  return support.equations.with_costs(blade.equations.with_costs(std::move(description)));
}

Structure RotorEquations::structure(const std::vector<int>& moving) const {
  const bool same_speed = std::none_of(moving.begin(), moving.end(), [&](int parameter) {
    return data().parameters.depends_on(speed, parameter);
  });
  Structure result = structure_of({&blade.equations, &support.equations}, moving);
  result.gyroscopic = true;
  // The damping of blades acts in the turning frame: Omega C (DG) is unsymmetric.
  result.circulatory = result.circulatory || blade.equations.structure(moving).damped;
  result.constant_damping = result.constant_damping && result.constant_mass && same_speed;
  result.constant_stiffness = result.constant_stiffness && result.constant_damping;
  return result;
}

template <class Real>
EvaluationFault RotorEquations::residual(const BasicPath<Real>& path, int order,
                                         BasicSteadyResidual<Real>& result, EvaluationCounts& counts) const {
  return RotorAssembly<Real>(*this, path, order).residual(result, counts);
}

template <class Real>
EvaluationFault RotorEquations::linearize(const BasicPath<Real>& path, int order,
                                          BasicLinearization<Real>& result, EvaluationCounts& counts) const {
  return RotorAssembly<Real>(*this, path, order).linearize(result, counts);
}

EvaluationFault RotorEquations::trim_rows(const Path& at, TrimDerivatives& result,
                                          EvaluationCounts& counts) const {
  return RotorAssembly<double>(*this, at, 0).trim_rows(result, counts);
}

template EvaluationFault RotorEquations::residual(const Path&, int, SteadyResidual&, EvaluationCounts&) const;
template EvaluationFault RotorEquations::residual(const BasicPath<Extended>&, int,
                                                  BasicSteadyResidual<Extended>&, EvaluationCounts&) const;
template EvaluationFault RotorEquations::linearize(const Path&, int, Linearization&, EvaluationCounts&) const;
template EvaluationFault RotorEquations::linearize(const BasicPath<Extended>&, int,
                                                   BasicLinearization<Extended>&, EvaluationCounts&) const;

}  // namespace eigentrail
