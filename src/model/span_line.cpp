#include "model/span_line.hpp"

#include <algorithm>

#include "model/beam_axis.hpp"

namespace eigentrail {
Combination sum_of(const std::vector<std::pair<Expression, Combination>>& parts) {
  Combination sum;
  for (const auto& [factor, part] : parts) {
    if (is_number(factor, 0.0)) continue;
    for (const auto& [triple, weight] : part) {
      const auto known =
          std::find_if(sum.begin(), sum.end(), [t = triple](const auto& one) { return one.first == t; });
      if (known == sum.end())
        sum.emplace_back(triple, factor * weight);
      else
        known->second = known->second + factor * weight;
    }
  }
  return sum;
}

std::vector<SpanPoint> points_of_beam(const Draft& draft, const BeamDraft& beam, int n,
                                      const std::array<double, 2>& extent) {
  const BeamAxis& axis = *beam.axis;
  std::vector<SpanPoint> points;
  for (int e = 0; e < axis.elements; ++e) {
    const double from = std::max(0.0, extent[0] * axis.elements - e);
    const double to = std::min(1.0, extent[1] * axis.elements - e);
    if (!(to > from)) continue;
    for (const auto& [at, weight] : gauss_points(n)) {
      const double xi = from + at * (to - from);
      const ShapeFunctions shape = shape_functions(axis.degree, xi);
      SpanPoint& point = points.emplace_back();
      point.share = (e + xi) / axis.elements;
      for (std::size_t a = 0; a < shape.value.size(); ++a) {
        const int triple = draft.bodies[beam.first_body + axis.node(e, a)].triple;
        point.position.emplace_back(triple, shape.value[a]);
        point.y.emplace_back(triple + 2, shape.value[a]);
        point.z.emplace_back(triple + 3, shape.value[a]);
      }
      point.width = Expression(weight * (to - from)) * axis.stretch(e, shape);
    }
  }
  return points;
}

std::vector<SpanPoint> points_of_body(const Draft& draft, const BodyLine& line, int n,
                                      const std::array<double, 2>& extent) {
  const ExpressionVector span = line.tip - line.root;
  const Expression length = sqrt(dot(span, span));
  std::vector<SpanPoint> points;
  for (const auto& [at, weight] : gauss_points(n)) {
    const double share = extent[0] + at * (extent[1] - extent[0]);
    Combination position = draft.on_directors(line.body, line.root + Expression(share) * span);
    position.emplace_back(draft.bodies[static_cast<std::size_t>(line.body)].triple, 1.0);
    points.push_back({share, std::move(position), draft.on_directors(line.body, line.y),
                      draft.on_directors(line.body, line.z),
                      Expression(weight * (extent[1] - extent[0])) * length});
  }
  return points;
}

}  // namespace eigentrail
