#include "continuation/events/criterion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eigentrail/core/series.hpp"

namespace eigentrail {
namespace {

using RealSeries = Series<double, max_order>;

/// Damping ratio zeta that belongs to a logarithmic decrement: delta = 2 pi zeta / sqrt(1 - zeta^2).
double ratio_of_decrement(double decrement) {
  return decrement / std::hypot(2.0 * std::numbers::pi, decrement);
}

double constant_term(double value) {
  return value;
}
double constant_term(const RealSeries& value) {
  return value[0];
}

/// The criterion at mu = re + im j. Scalar: double, or a power series.
template <class Scalar>
Scalar evaluate(const Criterion& criterion, const Scalar& re, const Scalar& im, Chart chart,
                const Scalar& excitation) {
  using std::sqrt;
  // A rotor that turns the other way is excited as often.
  const Scalar exciting = constant_term(excitation) < 0.0 ? -excitation : excitation;
  const Scalar square = re * re + im * im;
  switch (criterion.kind) {
    case EventKind::damping_ratio:
      return re + criterion.value * sqrt(square);
    case EventKind::log_decrement:
      return re + ratio_of_decrement(criterion.value) * sqrt(square);
    case EventKind::resonance:
      return chart == Chart::finite ? im - criterion.value * exciting
                                    : -im - criterion.value * (exciting * square);
    case EventKind::band_edge:
      return chart == Chart::finite ? im - criterion.value : -im - criterion.value * square;
    case EventKind::extremum:
      return re / sqrt(square);
    case EventKind::flutter:
    case EventKind::divergence:
    case EventKind::collision:
    case EventKind::crossing:
    case EventKind::veering:
    case EventKind::fold:
    case EventKind::branch_point:
    case EventKind::cusp:
      break;
  }
  return re;
}

RealSeries as_series(const Vector& coefficients) {
  RealSeries series;
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(coefficients.size(), max_order + 1); ++k)
    series[static_cast<int>(k)] = coefficients[k];
  return series;
}

Vector coefficients_of(const RealSeries& series, Eigen::Index count) {
  Vector coefficients(count);
  for (Eigen::Index k = 0; k < count; ++k) coefficients[k] = series[static_cast<int>(k)];
  return coefficients;
}

}  // namespace

std::vector<Criterion> criteria_of(const EventOptions& options) {
  std::vector<Criterion> criteria{{EventKind::flutter, 0.0}};
  for (const WantedEvent& event : options.wanted) criteria.push_back({event.kind, event.value});
  if (options.extrema) criteria.push_back({EventKind::extremum, 0.0});
  return criteria;
}

std::optional<Criterion> criterion_of(const Event& event) {
  switch (event.kind) {
    case EventKind::flutter:
    case EventKind::divergence:
      return Criterion{EventKind::flutter, 0.0};
    case EventKind::damping_ratio:
    case EventKind::log_decrement:
    case EventKind::resonance:
    case EventKind::band_edge:
      return Criterion{event.kind, event.value};
    case EventKind::collision:
    case EventKind::crossing:
    case EventKind::veering:
    case EventKind::fold:
    case EventKind::branch_point:
    case EventKind::extremum:
    case EventKind::cusp:
      break;
  }
  return std::nullopt;
}

Vector criterion_series(const Criterion& criterion, const ComplexVector& mu, Chart chart,
                        const Vector& excitation) {
  return coefficients_of(
      evaluate(criterion, as_series(mu.real()), as_series(mu.imag()), chart, as_series(excitation)),
      mu.size());
}

double criterion_value(const Criterion& criterion, Complex mu, Chart chart, double excitation) {
  return evaluate(criterion, mu.real(), mu.imag(), chart, excitation);
}

double criterion_value(const Criterion& criterion, Complex s, const EventOptions& options,
                       const Parameters& parameters, const Vector& values) {
  return criterion_value(criterion, s, Chart::finite, excitation_series(options, parameters, values, 0)[0]);
}

Vector excitation_series(const EventOptions& options, const Parameters& parameters,
                         const VectorSeries& series, int order) {
  if (!options.excitation) return Vector::Zero(order + 1);
  std::vector<RealSeries> values(parameters.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = as_series(series.row(static_cast<Eigen::Index>(i)).transpose());
  parameters.to_si(std::span<RealSeries>(values));
  return coefficients_of(options.excitation->evaluate(std::span<const RealSeries>(values)), order + 1);
}

}  // namespace eigentrail
