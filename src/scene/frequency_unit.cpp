#include "scene/frequency_unit.hpp"

#include "eigentrail/scene/units.hpp"

namespace eigentrail {

FrequencyUnit frequency_unit(const std::string& parameter_unit) {
  const auto unit = parse_unit(parameter_unit), hertz = parse_unit("Hz");
  if (unit && unit->dimension == hertz->dimension) return {parameter_unit, unit->factor};
  return {"Hz", hertz->factor};
}

}  // namespace eigentrail
