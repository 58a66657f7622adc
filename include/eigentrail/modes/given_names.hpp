// Names that a scene gives to modes: [modes] names = { surge = "0.01 Hz" }.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A name and the mode that gets it, where the trace begins. One of the three members says which.
struct GivenName {
  std::string name;
  double frequency =
      -1.0;  ///< the oscillating mode with the nearest damped frequency, rad/s; negative: not given
  std::string moves = {};  ///< the first mode whose own name holds this text, such as "blade lag"
  /// The mode whose shape is most like this one by modal assurance: coordinates and amounts.
  std::vector<std::pair<std::string, double>> shape = {};
};

/// A mode where the trace begins.
struct NamedMode {
  Complex s;
  ComplexVector shape;  ///< by coordinate
  std::string name;     ///< its own; empty: none
};

/// The numbers of the modes that get the names, all different, in the order of `given`: pairs that fit best
/// come first. Throws InputError, which begins with `label`, where a name finds no mode.
std::vector<std::size_t> modes_of_names(const std::vector<GivenName>& given,
                                        const std::vector<NamedMode>& modes,
                                        const std::vector<std::string>& coordinates,
                                        const std::string& label);

}  // namespace eigentrail
