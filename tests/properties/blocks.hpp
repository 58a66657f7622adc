// Blocks with planted special points. Coefficients are rounded to multiples of `quantum`; special points are
// those of the rounded block.
#pragma once

#include <string>

#include "properties/planted_family.hpp"

namespace eigentrail::test {

constexpr double quantum = 0x1p-36;  ///< of all coefficients of blocks

Wide rounded(Wide value, Wide unit = quantum);
Polynomial rounded(Polynomial a, Wide unit = quantum);

/// One freedom: s^2 + 2 damping s + stiffness.
PlantedBlock single(const std::string& kind, const Polynomial& damping, const Polynomial& stiffness);

/// [[mean + g, e], [+-e, mean - g]], g of degree one or two: veerings where g = +-j e (symmetric), or
/// exceptional points where g = +-e. Throws UnusableFamily where e vanishes in rounding.
PlantedBlock two_coupled(const std::string& kind, Wide c, const Polynomial& mean, Polynomial g, Wide e,
                         bool symmetric);

/// [[mean, b], [delta / b, mean]] with b a power of two: exceptional points where delta vanishes, all its
/// roots real. Throws UnusableFamily where rounding makes two of them complex.
PlantedBlock companion(const std::string& kind, Wide c, const Polynomial& mean, Polynomial delta);

/// A steep mode that meets two others at `first` and `second`: [[a, e1, e2], [e1, base, 0], [e2, 0, d]] with
/// a = base + slope (p - first). Throws UnusableFamily where its exceptional points are not found.
PlantedBlock shared_veerings(Wide c, Wide base, Wide slope, Wide first, Wide second, Wide e1, Wide e2);

}  // namespace eigentrail::test
