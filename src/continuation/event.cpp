#include "eigentrail/continuation/event.hpp"

#include "eigentrail/core/text.hpp"

namespace eigentrail {

std::string event_name(EventKind kind) {
  switch (kind) {
    case EventKind::flutter:
      return "flutter";
    case EventKind::divergence:
      return "divergence";
    case EventKind::collision:
      return "collision";
    case EventKind::crossing:
      return "crossing";
    case EventKind::veering:
      return "veering";
    case EventKind::fold:
      return "fold";
    case EventKind::pitchfork:
      return "pitchfork";
    case EventKind::damping_ratio:
      return "damping_ratio";
    case EventKind::resonance:
      return "resonance";
    case EventKind::extremum:
      return "extremum";
  }
  return "unknown";
}

std::string event_line(const Event& event) {
  std::string modes;
  for (const int mode : event.modes) modes += (modes.empty() ? "" : ";") + std::to_string(mode + 1);
  return event_name(event.kind) + ',' + exact_text(event.p) + ',' + exact_text(event.s.real()) + ',' +
         exact_text(event.s.imag()) + ',' + modes;
}

}  // namespace eigentrail
