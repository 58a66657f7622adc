// A change of the variable of power series: reversion and composition, truncated.
#pragma once

#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// Coefficients of the inverse function of sigma(h), both zero at zero; sigma_1 must not vanish.
Vector reversion(const Vector& sigma);

/// Row j: coefficients of h(u)^j.
Matrix power_table(const Vector& h);

/// Series with the coefficients as columns, composed with h(u) in place; a constant stays one column.
template <class Series>
void compose_columns(Series& series, const Matrix& powers) {
  if (series.cols() <= 1) return;
  const Series old = series;
  series = Series::Zero(old.rows(), powers.cols());
  for (Eigen::Index j = 0; j < old.cols(); ++j) series += old.col(j) * powers.row(j);
}

/// The same for series with matrices as coefficients.
template <class Coefficient>
void compose(std::vector<Coefficient>& series, const Matrix& powers) {
  if (series.size() <= 1) return;
  const std::vector<Coefficient> old = series;
  series.assign(static_cast<std::size_t>(powers.cols()), Coefficient::Zero(old[0].rows(), old[0].cols()));
  for (std::size_t j = 0; j < old.size(); ++j) {
    for (std::size_t k = 0; k < series.size(); ++k)
      series[k] += powers(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) * old[j];
  }
}

/// The same for coefficients that may be sparse.
void compose(SystemSeries& series, const Matrix& powers);

}  // namespace eigentrail
