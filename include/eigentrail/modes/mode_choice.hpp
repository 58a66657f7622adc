// Which modes of a spectrum are followed: all, some of the lowest, those in a band of frequencies, those
// about a frequency, those that are not heavily damped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/reduction/independent_parts.hpp"

namespace eigentrail {

/// A band of damped frequencies Im s, in rad/s, ends included; 0 <= lowest < highest.
struct FrequencyBand {
  double lowest = 0.0, highest = 0.0;

  bool operator==(const FrequencyBand&) const = default;
};

/// The choice; with nothing set, all modes.
struct ModeChoice {
  std::optional<int> count = {};             ///< at most that many, >= 1
  std::optional<FrequencyBand> band = {};    ///< modes with Im s in it; real eigenvalues have Im s = 0
  std::optional<double> damping_below = {};  ///< modes with a damping ratio -Re s / |s| below this
  std::optional<double> near = {};  ///< rad/s: modes by their distance from i times this, not from zero

  bool operator==(const ModeChoice&) const = default;

  bool is_all() const { return *this == ModeChoice(); }
  /// Whether modes may be wanted elsewhere on the range that were not wanted where it begins.
  bool may_grow() const { return (band || damping_below) && !count; }
  /// Whether an eigenvalue, Im s >= 0, lies in the band and is damped as little as asked for.
  bool wants(Complex s) const;
};

/// Marks eigenvalues zero of parts of one freedom that have no stiffness for any value of the parameter.
void mark_permanent_zeros(const IndependentParts& parts, std::vector<StartingMode>& modes);

/// Permanent zeros are chosen only with all modes. Brings the chosen modes of a spectrum to its front, by
/// increasing |s|, the others behind them likewise. Where nothing lies in the band, or everything is damped
/// more, the mode that misses it least is chosen. Returns the number of the chosen ones.
int choose_modes(const ModeChoice& choice, std::vector<StartingMode>& modes);

/// The choice in the words of a scene: "all", "12", or "count = 12, band = [0.5, 20]" with frequencies in
/// rad/s.
std::string text_of(const ModeChoice& choice);

/// "the 12 lowest modes", "the modes with Im s between 0.5 and 20 rad/s", ... for messages.
std::string in_words(const ModeChoice& choice);

}  // namespace eigentrail
