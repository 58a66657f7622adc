// Vectors and rotations whose components are expressions of the parameters.
#pragma once

#include <array>

#include "eigentrail/scene/expression.hpp"

namespace eigentrail {

/// Whether an expression is this number for all values of the parameters.
inline bool is_number(const Expression& e, double value) {
  return e.is_constant() && e.value() == value;
}

using ExpressionVector = std::array<Expression, 3>;

/// Rotation of a body; its columns are the axes of the body in the frame.
using ExpressionRotation = std::array<ExpressionVector, 3>;

inline ExpressionVector operator+(const ExpressionVector& a, const ExpressionVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline ExpressionVector operator-(const ExpressionVector& a, const ExpressionVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline ExpressionVector operator*(const Expression& s, const ExpressionVector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline Expression dot(const ExpressionVector& a, const ExpressionVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline ExpressionVector cross(const ExpressionVector& a, const ExpressionVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline ExpressionVector normalized(const ExpressionVector& a) {
  return (Expression(1.0) / sqrt(dot(a, a))) * a;
}

/// R a: components in the frame of a vector a given in body axes.
inline ExpressionVector turned(const ExpressionRotation& R, const ExpressionVector& a) {
  return a[0] * R[0] + a[1] * R[1] + a[2] * R[2];
}

/// R^T a: components in body axes of a vector a given in the frame.
inline ExpressionVector turned_back(const ExpressionRotation& R, const ExpressionVector& a) {
  return {dot(R[0], a), dot(R[1], a), dot(R[2], a)};
}

inline ExpressionVector unit_vector(std::size_t axis) {
  ExpressionVector e;
  e[axis] = 1.0;
  return e;
}

inline ExpressionRotation no_rotation() {
  return {unit_vector(0), unit_vector(1), unit_vector(2)};
}

}  // namespace eigentrail
