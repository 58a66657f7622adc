#include "continuation/events/veering_place.hpp"

#include <cmath>

namespace eigentrail {
namespace {

/// The exceptional point near h. The mean of the two eigenvalues varies little between the real axis and a
/// close exceptional point; for farther ones it is followed there.
std::optional<ExceptionalPoint> exceptional_point_near(const ReducedPencil& pencil, Chart chart, Complex h,
                                                       const std::array<Complex, 2>& mu, double allowed) {
  const auto from = [&](Complex mean) -> std::optional<ExceptionalPoint> {
    const double reach = allowed + std::abs(h.imag());
    const auto point = find_exceptional_point(pencil, chart, h, mean, reach, {});
    return point && std::abs(point->h - h) <= allowed ? point : std::nullopt;
  };
  if (const auto point = from(0.5 * (mu[0] + mu[1]))) return point;
  const auto mean = mean_at(pencil, chart, 0.0, h, mu);
  return mean ? from(*mean) : std::nullopt;
}

}  // namespace

std::optional<VeeringPlace> located_veering(const ReducedPencil& pencil, Chart chart, VeeringPlace seen,
                                            const std::array<Complex, 2>& mu, double allowed) {
  VeeringPlace sum;
  double count = 0.0;
  for (const double sign : {1.0, -1.0}) {
    const Complex h(seen.offset, sign * seen.half_width);
    const auto point = exceptional_point_near(pencil, chart, h, mu, allowed);
    if (!point) continue;
    sum.offset += point->h.real();
    sum.half_width += std::abs(point->h.imag());
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return VeeringPlace{sum.offset / count, sum.half_width / count};
}

}  // namespace eigentrail
