// Change of the variable of truncated power series: reversion and composition.
#pragma once

#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// Coefficients of the inverse function h(u) of u = sigma(h); both have constant term 0. sigma_1 must not be
/// zero.
Vector reversion(const Vector& sigma);

/// Table of powers: row j holds the coefficients of h(u)^j. Square, of the size of h.
Matrix power_table(const Vector& h);

/// Composes a series, whose coefficients are columns, with h(u) in place; `powers` is the power table of h. A
/// constant series keeps its single column.
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
