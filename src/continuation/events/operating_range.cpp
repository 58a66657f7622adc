#include "eigentrail/continuation/operating_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// Distance of `speed` from an end of a range, as a fraction of the end.
double fraction_of(double end, double speed) {
  return end > 0.0 ? std::abs(speed - end) / end : std::numeric_limits<double>::infinity();
}

Separation separation_from(const OperatingRange& range, const std::optional<double>& margin, double speed,
                           double amplification) {
  Separation result{range};
  const bool below = speed<range.from, above = speed> range.to;
  result.inside = !below && !above;
  if (below) result.distance = fraction_of(range.from, speed);
  if (above) result.distance = fraction_of(range.to, speed);
  // Inside, any margin is missed; the smaller one of the standard says whether one is wanted.
  result.wanted = margin ? *margin : api_margin(amplification, !above);
  return result;
}

}  // namespace

double amplification_factor(Complex s) {
  const double twice_ratio = -2.0 * s.real() / std::abs(s);
  return twice_ratio > 0.0 ? 1.0 / twice_ratio : std::numeric_limits<double>::infinity();
}

double api_margin(double amplification, bool below) {
  constexpr double critically_damped = 2.5;
  if (!(amplification >= critically_damped)) return 0.0;
  const double grows = 0.17 * (1.0 - 1.0 / (amplification - 1.5));
  return below ? std::min(0.16, grows) : std::min(0.26, 0.10 + grows);
}

std::optional<Separation> separation(const OperatingRanges& operating, double speed, Complex s) {
  std::optional<Separation> worst;
  const auto missing = [](const Separation& of) { return of.wanted - of.distance; };
  for (const OperatingRange& range : operating.ranges) {
    const Separation here =
        separation_from(range, operating.margin, std::abs(speed), amplification_factor(s));
    if (!worst || missing(here) > missing(*worst)) worst = here;
  }
  return worst;
}

OperatingRange speeds_in_question(const OperatingRanges& operating) {
  const double sharpest = std::numeric_limits<double>::infinity();
  OperatingRange all{sharpest, 0.0};
  for (const OperatingRange& range : operating.ranges) {
    all.from = std::min(all.from, range.from * (1.0 - operating.margin.value_or(api_margin(sharpest, true))));
    all.to = std::max(all.to, range.to * (1.0 + operating.margin.value_or(api_margin(sharpest, false))));
  }
  return all;
}

std::string ranges_text(const OperatingRanges& operating) {
  return joined(operating.ranges, ", ", [](const OperatingRange& range) {
    return exact_text(range.from) + " to " + exact_text(range.to);
  });
}

std::string margin_text(const OperatingRanges& operating) {
  return operating.margin ? exact_text(*operating.margin) : "API 684";
}

}  // namespace eigentrail
