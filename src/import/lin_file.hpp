// Linearization files of OpenFAST (.lin, text): the state matrix A at one azimuth of the rotor and what the
// file says about its states.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A row of a table of states, inputs or outputs.
struct LinQuantity {
  std::string description;  ///< as in the file, "ED 1st tower fore-aft bending mode DOF (...), m"
  double value = 0.0;       ///< operating point; of several numbers, the first
  bool rotating = false;
  int derivative_order = 1;
};

struct LinFile {
  std::string path;
  double rotor_speed = 0.0;          ///< rad/s
  double azimuth = 0.0;              ///< rad, of blade 1
  std::optional<double> wind_speed;  ///< m/s
  std::vector<LinQuantity> states;
  std::vector<LinQuantity> operating_values;  ///< inputs and outputs
  Matrix A;                                   ///< states x states
  int digits = 17;                            ///< of the entries of A, as printed and as computed
};

/// Reads the text of a file. Throws InputError that names file and line.
LinFile parse_lin_file(std::string_view text, const std::string& path);

}  // namespace eigentrail
