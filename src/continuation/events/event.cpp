#include "eigentrail/continuation/event.hpp"

#include "core/texts.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {

std::string event_name(EventKind kind) {
  return std::string(event_kind(kind).name);
}

std::string event_line(const Event& event) {
  const std::string modes = joined(event.modes, ";", [](int mode) { return std::to_string(mode + 1); });
  return event_name(event.kind) + ',' + exact_text(event.p) + ',' + exact_text(event.s.real()) + ',' +
         exact_text(event.s.imag()) + ',' + modes;
}

}  // namespace eigentrail
