// What the descriptions of OpenFAST's states say.
#pragma once

#include <string>
#include <vector>

namespace eigentrail {

/// "ED First time derivative of 1st flapwise bending-mode DOF of blade 2 (internal DOF index = DOF_BF(2,1)),
/// m/s" is the rate of the motion "1st flap" of blade 2, in m/s.
struct OpenFastState {
  std::string motion;    ///< without the blade
  std::string unit;      ///< empty if none is given
  int blade = 0;         ///< from 1; 0: of no blade
  bool is_rate = false;  ///< time derivative of the motion
};

OpenFastState openfast_state(const std::string& description);

/// "1st flap, blade 2 velocity".
std::string short_name(const OpenFastState& state);

/// The short names of states with OpenFAST's descriptions; the names as they are if they are no such
/// descriptions, or if short names would be equal.
std::vector<std::string> short_openfast_names(const std::vector<std::string>& names);

}  // namespace eigentrail
