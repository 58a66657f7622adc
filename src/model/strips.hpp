// Cuts blades into strips for their aerodynamics.
#pragma once

#include <optional>
#include <utility>

#include "model/draft.hpp"

namespace eigentrail {

/// The strips of all [[blade_element]] tables with their labels: Gauss points from root to tip, so that loads
/// that are polynomials of degree 2 n - 1 along the span are summed exactly. `rotation` is the frame's.
std::vector<std::pair<BladeElement, std::string>> read_strips(
    Draft& draft, const std::optional<ExpressionVector>& rotation);

/// The keys of a [[blade_element]] table.
std::vector<FieldHelp> strip_fields();

}  // namespace eigentrail
