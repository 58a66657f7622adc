// Divides blades into strips for their aerodynamics.
#pragma once

#include <optional>
#include <utility>

#include "model/draft.hpp"

namespace eigentrail {

/// The strips of all [[blade_element]] tables with their labels. The strips are at the n Gauss points between
/// root and tip, so loads that are polynomials of degree up to 2 n - 1 along the span are integrated exactly.
/// `rotation` is the angular velocity of the frame.
std::vector<std::pair<BladeElement, std::string>> read_strips(
    Draft& draft, const std::optional<ExpressionVector>& rotation);

/// The keys of a [[blade_element]] table.
std::vector<FieldHelp> strip_fields();

}  // namespace eigentrail
