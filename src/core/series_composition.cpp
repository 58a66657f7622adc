#include "core/series_composition.hpp"

namespace eigentrail {

Vector reversion(const Vector& sigma) {
  const Eigen::Index count = sigma.size();
  Vector h = Vector::Zero(count);
  h[1] = 1.0 / sigma[1];
  for (Eigen::Index k = 2; k < count; ++k) {
    // In coefficient k of sigma(h(u)) = u the unknown h_k appears only in sigma_1 h_k. The sum is that
    // coefficient with h_k = 0; h_k cancels it.
    const Matrix powers = power_table(h);
    double sum = 0.0;
    for (Eigen::Index j = 1; j <= k; ++j) sum += sigma[j] * powers(j, k);
    h[k] = -sum / sigma[1];
  }
  return h;
}

Matrix power_table(const Vector& h) {
  const Eigen::Index count = h.size();
  Matrix table = Matrix::Zero(count, count);
  table(0, 0) = 1.0;
  for (Eigen::Index j = 1; j < count; ++j) {
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; a + b < count; ++b) table(j, a + b) += table(j - 1, a) * h[b];
    }
  }
  return table;
}

void compose(SystemSeries& series, const Matrix& powers) {
  if (series.size() <= 1) return;
  const SystemSeries old = series;
  series.assign(static_cast<std::size_t>(powers.cols()), old[0].zero());
  for (std::size_t j = 0; j < old.size(); ++j) {
    for (std::size_t k = 0; k < series.size(); ++k)
      series[k].add_scaled(powers(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)), old[j]);
  }
}

}  // namespace eigentrail
