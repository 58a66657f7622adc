// Lag of the lift behind the motion: vortices that a wing has shed hold its circulation back.
//
// After a step of the downwash w the circulation is that of w phi(s), s = V t / b the way in half chords,
// with Wagner's function (1925) in the approximation of R. T. Jones (NACA Report 681, 1940)
//
//     phi(s) = 1 - A_1 exp(-b_1 s) - A_2 exp(-b_2 s),   A = (0.165, 0.335), b = (0.0455, 0.3)
//
// by superposition that of w + sum (x_i - A_i w), with a state for each exponential,
//
//     0 = A_i w - x_i - b / (b_i V) x_i'
//
// so harmonic motion of reduced frequency k = omega b / V has Theodorsen's function
// C(k) = 1 - sum A_i i k / (i k + b_i), within 2.4 % of the exact one. This element adds the lift of
// sum (x_i - A_i w); that of w is the one of Strip. Two such elements on a strip have four exponentials.
#pragma once

#include "model/elements/air_section.hpp"

namespace eigentrail {

struct LiftLag : AirSection {
  static constexpr std::string_view name = "lift_lag";
  static constexpr std::string_view description =
      "lag of the lift of strips behind their motion (Wagner, Jones)";
  static constexpr Contribution contribution{
      .conservative = true, .circulatory = true, .dissipative = true, .gyroscopic = true};
  static constexpr std::array states{OwnState{"slow", "m/s", "downwash that has come into effect, slow part"},
                                     OwnState{"fast", "m/s", "likewise, fast part"}};

  std::array<Quantity, 2> shares, rates;  ///< A_i, b_i

  static void fields(auto& self, auto& visit) {
    AirSection::fields(self, visit);
    visit.numbers(self.shares, self.rates);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    AirFlow<Scalar> air(*this, at);
    const Scalar time = 0.5 * at.value(chord) / sqrt(air.speed_squared());
    Scalar effective = air.downwash;
    for (int i = 0; i < 2; ++i) {
      const auto index = static_cast<std::size_t>(i);
      const Scalar missing = at.value(shares[index]) * air.downwash - at.state(i);
      effective -= missing;
      at.add_to_state(i, missing - time / at.value(rates[index]) * at.state_rate(i));
    }
    const Scalar change = air.circulation(effective) - air.circulation(air.downwash);
    air.add_force(air.lift_of(change));
  }
};

}  // namespace eigentrail
