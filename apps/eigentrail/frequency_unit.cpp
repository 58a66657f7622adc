#include "frequency_unit.hpp"

#include "eigentrail/scene/units.hpp"

namespace eigentrail::app {

FrequencyUnit frequency_unit(const Parameter& traced) {
  const bool is_frequency = traced.dimension && *traced.dimension == parse_unit("Hz")->dimension;
  if (is_frequency) return {traced.unit, traced.factor};
  return {"Hz", *unit_factor("Hz")};
}

}  // namespace eigentrail::app
