// Divides blades into strips for their aerodynamics.
#pragma once

#include <optional>

#include "model/span_line.hpp"

namespace eigentrail {

/// Adds the strips of all [[blade_element]] tables. They are at the n Gauss points between root and tip, so
/// loads that are polynomials of degree up to 2 n - 1 along the span are integrated exactly. `rotation` is
/// the angular velocity of the frame.
void read_strips(Draft& draft, const std::optional<ExpressionVector>& rotation);

/// Reads the line on a body along which strips are: from `root` to `tip`, y the direction `leading` and z the
/// part of `lift` across it. `usual_axes`: those of leading and lift by default; absent: they are required.
BodyLine read_body_line(Draft& draft, TableReader& table, int body,
                        const std::optional<std::array<ExpressionVector, 2>>& usual_axes = std::nullopt);

/// Reads the number of strips, 1 to 64.
int read_strip_count(TableReader& table, int otherwise);

/// The keys of a [[blade_element]] table.
std::vector<FieldHelp> strip_fields();

}  // namespace eigentrail
