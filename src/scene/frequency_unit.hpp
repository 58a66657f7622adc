// The unit in which frequencies are shown.
#pragma once

#include <string>

namespace eigentrail {

struct FrequencyUnit {
  std::string name;
  double factor;  ///< rad/s in one unit
};

/// That of the traced parameter if it is a speed or a frequency, so that both can be compared and the first
/// harmonic is the diagonal; Hz otherwise.
FrequencyUnit frequency_unit(const std::string& parameter_unit);

}  // namespace eigentrail
