// Dimensions of physical quantities: powers of the base units kg, m, s, A and K of the SI. Angles are numbers
// (1 rad = 1), as in the SI.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace eigentrail {

struct Dimension {
  /// Powers of kg, m, s, A, K. Square roots and powers such as ^1.5 make fractions of them.
  std::array<double, 5> powers{};

  bool is_number() const { return *this == Dimension{}; }

  friend bool operator==(const Dimension& a, const Dimension& b) {
    // Sums of a few fractions such as 1/3, each rounded; different dimensions differ by much more.
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < a.powers.size(); ++i) {
      if (std::abs(a.powers[i] - b.powers[i]) > rounding) return false;
    }
    return true;
  }
  friend Dimension operator*(Dimension a, const Dimension& b) {
    for (std::size_t i = 0; i < a.powers.size(); ++i) a.powers[i] += b.powers[i];
    return a;
  }
  friend Dimension operator/(const Dimension& a, const Dimension& b) { return a * pow(b, -1.0); }
  friend Dimension pow(Dimension a, double exponent) {
    for (double& power : a.powers) power *= exponent;
    return a;
  }
};

/// The SI unit of a dimension, with a usual name if it has one: "N/m", "kg m^2", "m^0.5 s^-1"; "1" for
/// numbers.
std::string si_unit(const Dimension& dimension);

}  // namespace eigentrail
