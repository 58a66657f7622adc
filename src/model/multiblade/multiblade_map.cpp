#include "model/multiblade/multiblade_map.hpp"

#include <array>
#include <cstddef>

namespace eigentrail {
namespace {

/// A triple of the turned hub depends on a triple of the hub by a multiple of one of these matrices: the mean
/// of R^T, and its factors of cos(psi) and sin(psi).
enum class Turn { mean, cosine, sine };

/// A factor of the function with index `harmonic` (0: mean, 1: cosine, 2: sine) in the turn of the hub.
/// Triples are q0, d1, d2, d3.
struct HubTurn {
  std::size_t harmonic;
  int seen, own;  ///< triples: as the blade sees it, and of the hub
  Turn turn;
  double factor;
};

constexpr std::array<HubTurn, 14> hub_turns = {{{0, 0, 0, Turn::mean, 1.0},
                                                {1, 0, 0, Turn::cosine, 1.0},
                                                {2, 0, 0, Turn::sine, 1.0},
                                                {0, 3, 3, Turn::mean, 1.0},
                                                {1, 3, 3, Turn::cosine, 1.0},
                                                {2, 3, 3, Turn::sine, 1.0},
                                                {0, 1, 1, Turn::cosine, 0.5},
                                                {0, 1, 2, Turn::sine, 0.5},
                                                {1, 1, 1, Turn::mean, 1.0},
                                                {2, 1, 2, Turn::mean, 1.0},
                                                {0, 2, 1, Turn::sine, -0.5},
                                                {0, 2, 2, Turn::cosine, 0.5},
                                                {1, 2, 2, Turn::mean, 1.0},
                                                {2, 2, 1, Turn::mean, -1.0}}};

struct TurnEntry {
  int row, column;
  double value;
};

std::vector<TurnEntry> entries(Turn turn) {
  switch (turn) {
    case Turn::mean:
      return {{2, 2, 1.0}};
    case Turn::cosine:
      return {{0, 0, 1.0}, {1, 1, 1.0}};
    default:
      return {{0, 1, 1.0}, {1, 0, -1.0}};
  }
}

}  // namespace

RotorShares MultibladeMap::blade_shares(std::size_t harmonic) const {
  RotorShares result(blade.size());
  for (std::size_t i = 0; i < blade.size(); ++i) {
    if (blade[i] >= 0) result[i] = {{blade[i] + static_cast<int>(harmonic) * stride[i], 1.0}};
  }
  for (const HubTurn& part : hub_turns) {
    if (part.harmonic != harmonic) continue;
    for (const TurnEntry& entry : entries(part.turn)) {
      const auto seen = static_cast<std::size_t>(hub_coordinate + 3 * part.seen + entry.row);
      const auto own = static_cast<std::size_t>(hub_coordinate + 3 * part.own + entry.column);
      result[seen].push_back({support[own], part.factor * entry.value});
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
