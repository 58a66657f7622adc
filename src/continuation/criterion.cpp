#include "continuation/criterion.hpp"

#include <cmath>

#include "eigentrail/core/series.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Series of |mu|^2.
Vector magnitude_squared(const ComplexVector& mu) {
  return multiply_series(mu, mu.conjugate()).real();
}

Vector square_root(const Vector& x) {
  Vector y = Vector::Zero(x.size());
  y[0] = std::sqrt(x[0]);
  for (Eigen::Index k = 1; k < x.size(); ++k) {
    double rest = x[k];
    for (Eigen::Index j = 1; j < k; ++j) rest -= y[j] * y[k - j];
    y[k] = rest / (2.0 * y[0]);
  }
  return y;
}

Vector product(const Vector& a, const Vector& b) {
  Vector result = Vector::Zero(a.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    for (Eigen::Index j = 0; i + j < a.size(); ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}

}  // namespace

std::vector<Criterion> criteria_of(const EventOptions& options) {
  std::vector<Criterion> criteria{{EventKind::flutter, 0.0}};
  for (const double ratio : options.damping_ratios) criteria.push_back({EventKind::damping_ratio, ratio});
  for (const double harmonic : options.harmonics) criteria.push_back({EventKind::resonance, harmonic});
  if (options.extrema) criteria.push_back({EventKind::extremum, 0.0});
  return criteria;
}

Vector criterion_series(const Criterion& criterion, const ComplexVector& mu, Chart chart,
                        const Vector& excitation) {
  switch (criterion.kind) {
    case EventKind::damping_ratio:
      return mu.real() + criterion.value * square_root(magnitude_squared(mu));
    case EventKind::resonance:
      if (chart == Chart::finite) return mu.imag() - criterion.value * excitation;
      return -mu.imag() - criterion.value * product(excitation, magnitude_squared(mu));
    case EventKind::extremum: {
      const Vector size = square_root(magnitude_squared(mu));
      return product(mu.real(), reciprocal_series(size.cast<Complex>()).real());
    }
    default:
      return mu.real();
  }
}

double criterion_value(const Criterion& criterion, Complex mu, Chart chart, double excitation) {
  switch (criterion.kind) {
    case EventKind::damping_ratio:
      return mu.real() + criterion.value * std::abs(mu);
    case EventKind::resonance:
      return chart == Chart::finite ? mu.imag() - criterion.value * excitation
                                    : -mu.imag() - criterion.value * excitation * std::norm(mu);
    case EventKind::extremum:
      return mu.real() / std::abs(mu);
    default:
      return mu.real();
  }
}

Vector excitation_series(const EventOptions& options, const Parameters& parameters,
                         const VectorSeries& series, int order) {
  Vector result = Vector::Zero(order + 1);
  if (!options.excitation) return result;
  using Scalar = Series<double, max_order>;
  std::vector<Scalar> values(parameters.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (Eigen::Index k = 0; k < series.cols() && k <= max_order; ++k)
      values[i][static_cast<int>(k)] = series(static_cast<Eigen::Index>(i), k);
  }
  parameters.to_si(std::span<Scalar>(values));
  const Scalar value = options.excitation->evaluate(std::span<const Scalar>(values));
  for (int k = 0; k <= order; ++k) result[k] = value[k];
  return result;
}

}  // namespace eigentrail
