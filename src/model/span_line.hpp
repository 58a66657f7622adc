// Lines along which strips are placed: the axis of a beam, or a straight line on a body.
#pragma once

#include "model/draft.hpp"

namespace eigentrail {

/// Sum of a factor times each of the combinations.
Combination sum_of(const std::vector<std::pair<Expression, Combination>>& parts);

/// A point of such a line, with the axes of the section there and the length that it stands for.
struct SpanPoint {
  double share = 0.0;  ///< 0 where the line begins, 1 where it ends
  Combination position, y, z;
  Expression width;
};

/// The n Gauss points of every element of a beam, or of its part within `extent`.
std::vector<SpanPoint> points_of_beam(const Draft& draft, const BeamDraft& beam, int n,
                                      const std::array<double, 2>& extent);

/// A straight line on a body, with directions in the body's axes.
struct BodyLine {
  int body = 0;
  ExpressionVector root, tip, y, z;
};

/// The n Gauss points of the part of the line within `extent`.
std::vector<SpanPoint> points_of_body(const Draft& draft, const BodyLine& line, int n,
                                      const std::array<double, 2>& extent);

}  // namespace eigentrail
