#include "continuation/events/event_search.hpp"

#include "core/texts.hpp"

namespace eigentrail {

std::string place_text(const TraceOptions& options, double p) {
  return options.parameter + " = " + short_text(p, 12);
}

}  // namespace eigentrail
