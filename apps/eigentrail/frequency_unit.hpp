// The unit in which frequencies are printed.
#pragma once

#include <string>

#include "eigentrail/scene/parameters.hpp"

namespace eigentrail::app {

struct FrequencyUnit {
  std::string name = "Hz";
  double factor;  ///< rad/s in one unit
};

/// That of the traced parameter if it is a speed or a frequency, so that both can be compared; Hz otherwise.
FrequencyUnit frequency_unit(const Parameter& traced);

}  // namespace eigentrail::app
