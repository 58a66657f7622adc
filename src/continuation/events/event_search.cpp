#include "continuation/events/event_search.hpp"

#include <sstream>

namespace eigentrail {

std::string place_text(const TraceOptions& options, double p) {
  std::ostringstream text;
  text.precision(12);
  text << options.parameter << " = " << p;
  return text.str();
}

}  // namespace eigentrail
