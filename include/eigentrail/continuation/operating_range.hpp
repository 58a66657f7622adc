// Operating ranges of a machine, and how far critical speeds must stay away from them.
//
// Source: API RP 684, Rotordynamic Tutorial, SP6.8.2.10 (API Std 617, 7th ed. 2002, chapter 1, 2.6.2.10).
// With the amplification factor AF of the critical speed, the separation margin is wanted
//   AF < 2.5                     0: the response is critically damped in the standard's words
//   below the lowest speed       min(16, 17 (1 - 1/(AF - 1.5))) percent of the lowest speed
//   above the highest speed      min(26, 10 + 17 (1 - 1/(AF - 1.5))) percent of the highest speed
// The standard measures AF at the peak of a response to unbalance. Here it is 1/(2 zeta) from the damping
// ratio zeta of the mode, to which the measured one tends for light damping.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Speeds between which a machine runs, in the unit of the traced parameter; 0 <= from <= to.
struct OperatingRange {
  double from = 0.0;
  double to = 0.0;
};

struct OperatingRanges {
  std::vector<OperatingRange> ranges = {};  ///< as in the scene; empty: none are given
  /// The wanted margin as a fraction of the nearer end of a range, not negative; empty: by API RP 684.
  std::optional<double> margin = {};
};

/// 1/(2 zeta) of an eigenvalue; infinite without damping, or where the mode grows.
double amplification_factor(Complex s);

/// The margin by API RP 684, as a fraction of the nearer end of the range.
double api_margin(double amplification, bool below);

/// How a critical speed lies to an operating range.
struct Separation {
  OperatingRange range;
  double distance = 0.0;  ///< from the nearer end, as a fraction of it; 0 inside the range
  double wanted = 0.0;    ///< the same for the least distance
  bool inside = false;
  bool is_too_close() const { return wanted > 0.0 && distance < wanted; }
};

/// The separation from the range to which most is wanting; empty without ranges. `speed`: where the mode with
/// the eigenvalue `s` is in resonance, in the unit of the ranges, in either sense of rotation.
std::optional<Separation> separation(const OperatingRanges& operating, double speed, Complex s);

/// The speeds between which a critical speed may be too close to an operating range, whatever its
/// amplification. There must be ranges.
OperatingRange speeds_in_question(const OperatingRanges& operating);

/// "3000 to 3600, 8000 to 9000", and "0.15" or "API 684": as the files have them.
std::string ranges_text(const OperatingRanges& operating);
std::string margin_text(const OperatingRanges& operating);

}  // namespace eigentrail
