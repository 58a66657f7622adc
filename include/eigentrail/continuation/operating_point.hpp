// The whole spectrum at one value of the parameter, without a trace.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// A mode at an operating point.
struct OperatingMode {
  Complex s;               ///< 1/s; of a complex pair the member with Im s > 0
  double condition = 0.0;  ///< relative condition number; infinite where the eigenvalue is defective
  double backward_error = 0.0;
  double rounding =
      0.0;              ///< error of s by rounding of the entries of the matrices, 1/s; infinite if not known
  ComplexVector shape;  ///< physical coordinates, of unit length
  std::string what_moves;  ///< "blade flap", or the coordinates that take part most: "q3 71 %, q4 24 %"
};

/// The eigenvalue as it is shown: zero where it is, or its real part is, within rounding.
Complex shown(const OperatingMode& mode);

struct OperatingPoint {
  double p = 0.0;
  std::string fault = {};                 ///< why there is no spectrum; empty if there is one
  bool none_in_band = false;              ///< the fault is that no mode lies in the chosen band
  std::vector<OperatingMode> modes = {};  ///< the chosen ones by increasing |s|, then others that grow
  std::string note = {};                  ///< that no mode is as wanted; empty else
};

/// The chosen modes (`modes` of the options), and all that grow, at values of the traced parameter, in its
/// unit. Where Newton's method finds no equilibrium it starts again from the last one found. Cost: a spectrum
/// by QZ and two LU per mode, for each value.
std::vector<OperatingPoint> operating_points(const TraceSetup& setup, const std::vector<double>& values);

}  // namespace eigentrail
