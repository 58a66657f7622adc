#include "model/multiblade/multiblade_map.hpp"

#include <array>
#include <cstddef>

namespace eigentrail {
namespace {

/// Factors of 1, cos(psi) and sin(psi).
using Turning = std::array<double, 3>;

/// The product without its second harmonic.
Turning product(const Turning& a, const Turning& b) {
  return {a[0] * b[0] + 0.5 * (a[1] * b[1] + a[2] * b[2]), a[0] * b[1] + a[1] * b[0],
          a[0] * b[2] + a[2] * b[0]};
}

/// An entry of a matrix that depends on the azimuth.
struct TurningEntry {
  int row, column;
  Turning factors;
};

/// Triples q0, d1, d2 and d3 of the turned hub, by those of the hub.
constexpr std::array<TurningEntry, 6> turned_triples = {{{0, 0, {1.0, 0.0, 0.0}},
                                                         {1, 1, {0.0, 1.0, 0.0}},
                                                         {1, 2, {0.0, 0.0, 1.0}},
                                                         {2, 1, {0.0, 0.0, -1.0}},
                                                         {2, 2, {0.0, 1.0, 0.0}},
                                                         {3, 3, {1.0, 0.0, 0.0}}}};

/// R^T
constexpr std::array<TurningEntry, 5> turned_axes = {{{0, 0, {0.0, 1.0, 0.0}},
                                                      {0, 1, {0.0, 0.0, 1.0}},
                                                      {1, 0, {0.0, 0.0, -1.0}},
                                                      {1, 1, {0.0, 1.0, 0.0}},
                                                      {2, 2, {1.0, 0.0, 0.0}}}};

}  // namespace

RotorShares MultibladeMap::blade_shares(std::size_t harmonic) const {
  RotorShares result(blade.size());
  for (std::size_t i = 0; i < blade.size(); ++i) {
    if (blade[i] >= 0) result[i] = {{blade[i] + static_cast<int>(harmonic) * stride[i], 1.0}};
  }
  for (const TurningEntry& triple : turned_triples) {
    for (const TurningEntry& axis : turned_axes) {
      const Turning factors = product(triple.factors, axis.factors);
      if (harmonic >= factors.size() || factors[harmonic] == 0.0) continue;
      const auto seen = static_cast<std::size_t>(hub_coordinate + 3 * triple.row + axis.row);
      const auto own = static_cast<std::size_t>(hub_coordinate + 3 * triple.column + axis.column);
      result[seen].push_back({support[own], factors[harmonic]});
    }
  }
  for (const InflowCoordinates& inflow : inflows) {
    const auto mean = static_cast<std::size_t>(inflow.first), x = mean + 1, y = mean + 2;
    if (harmonic == 0) result[mean] = {{support[mean], 1.0}};
    if (harmonic == 1) {
      result[x] = {{support[x], 1.0}};
      result[y] = {{support[y], 1.0}};
    }
    if (harmonic == 2) {
      result[x] = {{support[y], static_cast<double>(inflow.sense)}};
      result[y] = {{support[x], -static_cast<double>(inflow.sense)}};
    }
  }
  return result;
}

RotorShares MultibladeMap::support_shares() const {
  RotorShares result(support.size());
  for (std::size_t i = 0; i < support.size(); ++i) {
    if (support[i] >= 0) result[i] = {{support[i], 1.0}};
  }
  return result;
}

}  // namespace eigentrail
