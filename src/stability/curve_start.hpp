// The first point of a boundary curve, from a place where stability changes.
#pragma once

#include <optional>

#include "stability/curve_point.hpp"
#include "stability/line_scan.hpp"

namespace eigentrail {

struct CurveStart {
  std::optional<CurvePoint> point;  ///< empty if no curve begins here
  std::string failure;              ///< why Newton's method failed, in words; empty if it did not
  std::string remark;               ///< what the user should know of the place; empty without
  RunCounts counts;
};

/// The function whose zeros are the curve through a seed.
BoundaryFunction function_of(const BoundarySeed& seed, const BoundaryOptions& options);

/// Corrects a seed by Newton's method and expands the curve through it.
CurveStart start_curve(const Window& window, const BoundaryOptions& options, const BoundarySeed& seed);

}  // namespace eigentrail
