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

/// Reads the direction of lift, and returns the part across `leading`, a unit vector, of unit length. Both in
/// the axes of a body.
ExpressionVector read_lift(Draft& draft, TableReader& table, const ExpressionVector& leading,
                           std::optional<ExpressionVector> otherwise = std::nullopt);

/// Reads the number of strips, 1 to 64.
int read_strip_count(TableReader& table, int otherwise);

/// The keys of a [[blade_element]] table.
std::vector<FieldHelp> strip_fields();

}  // namespace eigentrail
