#include "eigentrail/continuation/event_kinds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

std::string rounded(double value) {
  return short_text(value, 6);
}

/// `up` or `down` by the sign of the direction; empty if it is zero.
std::string turns(const EventFacts& facts, const std::string& up, const std::string& down) {
  return facts.direction > 0 ? up : facts.direction < 0 ? down : "";
}

std::string no_remark(const EventFacts&) {
  return "";
}

std::string stability_remark(const EventFacts& facts) {
  return turns(facts, "unstable above", "unstable below");
}

std::string axis_remark(const EventFacts& facts) {
  return facts.direction == 0 ? "touches the imaginary axis" : stability_remark(facts);
}

std::string collision_remark(const EventFacts& facts) {
  const std::string stability = stability_remark(facts);
  Complex puiseux = facts.puiseux;
  if (!std::isfinite(puiseux.real()) || puiseux == 0.0) return stability;
  // The coefficient is real or imaginary where two real eigenvalues or a pair meet, but for rounding.
  constexpr double rounding = 1e-12;
  if (std::abs(puiseux.real()) < rounding * std::abs(puiseux)) puiseux.real(0.0);
  if (std::abs(puiseux.imag()) < rounding * std::abs(puiseux)) puiseux.imag(0.0);
  return stability + (stability.empty() ? "" : ", ") + "Puiseux coefficient " + rounded(puiseux.real()) +
         (std::signbit(puiseux.imag()) ? " - " : " + ") + rounded(std::abs(puiseux.imag())) + "j";
}

std::string veering_remark(const EventFacts& facts) {
  return "half-width " + rounded(facts.half_width);
}

std::string damping_remark(const EventFacts& facts) {
  return "ratio " + rounded(facts.value) + turns(facts, ", falling", ", rising");
}

std::string resonance_remark(const EventFacts& facts) {
  return "critical speed " + rounded(facts.value) + "x" +
         turns(facts, ", above it at higher values", ", below it at higher values");
}

std::string extremum_remark(const EventFacts& facts) {
  return (facts.direction > 0 ? "least damping ratio " : "largest damping ratio ") + rounded(facts.value);
}

std::string decrement_remark(const EventFacts& facts) {
  return "decrement " + rounded(facts.value) + turns(facts, ", falling", ", rising");
}

std::string band_remark(const EventFacts& facts) {
  return "of " + rounded(facts.value) + " rad/s" + turns(facts, ", rises through it", ", falls through it");
}

constexpr std::array<EventKindInfo, 13> kinds{{
    {EventKind::flutter, "flutter", "flutter", "x", true, axis_remark},
    {EventKind::divergence, "divergence", "divergence", "cross", true, axis_remark},
    {EventKind::collision, "collision", "collision", "star", true, collision_remark},
    {EventKind::crossing, "crossing", "crossing", "circle-open", false, no_remark},
    {EventKind::veering, "veering", "veering", "bowtie-open", false, veering_remark},
    {EventKind::fold, "fold", "fold", "triangle-left", true, no_remark},
    {EventKind::branch_point, "branch_point", "branch point", "asterisk-open", true, stability_remark},
    {EventKind::damping_ratio,
     "damping_ratio",
     "damping ratio",
     "square-open",
     false,
     damping_remark,
     // Zero is allowed: a damping ratio of zero is flutter, which every trace looks for.
     {"damping_ratio", "where the damping ratio of a pair has this value", "must lie between -1 and 1",
      [](double value) { return std::abs(value) < 1.0; }}},
    {EventKind::resonance,
     "resonance",
     "resonance",
     "diamond-open",
     true,
     resonance_remark,
     {"harmonics", "where Im s is this multiple of the excitation frequency", "must be positive",
      [](double value) { return value > 0.0 && std::isfinite(value); }, true}},
    {EventKind::extremum, "extremum", "extremum", "triangle-down-open", false, extremum_remark},
    {EventKind::log_decrement,
     "log_decrement",
     "logarithmic decrement",
     "hexagon-open",
     false,
     decrement_remark,
     {"log_decrement", "where the logarithmic decrement of a pair has this value", "must be a finite number",
      [](double value) { return std::isfinite(value); }}},
    {EventKind::band_edge, "band_edge", "edge of the band", "line-ew-open", false, band_remark},
    {EventKind::cusp, "cusp", "cusp", "pentagon-open", true, no_remark},
}};

}  // namespace

std::span<const EventKindInfo> event_kinds() {
  return kinds;
}

const EventKindInfo& event_kind(EventKind kind) {
  for (const EventKindInfo& info : kinds) {
    if (info.kind == kind) return info;
  }
  throw std::out_of_range("event_kind: no kind of an event has the number " +
                          std::to_string(static_cast<int>(kind)));
}

const EventKindInfo* find_event_kind(std::string_view name) {
  const auto* const found = std::find_if(kinds.begin(), kinds.end(),
                                         [name](const EventKindInfo& info) { return info.name == name; });
  return found == kinds.end() ? nullptr : found;
}

std::string event_name(EventKind kind) {
  return std::string(event_kind(kind).name);
}

std::string event_line(const Event& event) {
  const std::string modes = joined(event.modes, ";", [](int mode) { return std::to_string(mode + 1); });
  return event_name(event.kind) + ',' + exact_text(event.p) + ',' + exact_text(event.s.real()) + ',' +
         exact_text(event.s.imag()) + ',' + modes;
}

}  // namespace eigentrail
