#include "model/rotor/shaft_element.hpp"

#include <numbers>

namespace eigentrail {
namespace {

Expression square(const Expression& x) {
  return x * x;
}

/// c0 + c1 phi + c2 phi^2
Expression in_powers(const Expression& phi, double c0, double c1, double c2) {
  return Expression(c0) + Expression(c1) * phi + Expression(c2) * square(phi);
}

PlaneMatrix bending_stiffness(const Expression& factor, const Expression& length, const Expression& phi) {
  const Expression by_length = factor * length;
  const Expression by_square = by_length * length;
  return {Expression(12.0) * factor,           Expression(6.0) * by_length,
          Expression(-12.0) * factor,          Expression(6.0) * by_length,
          (Expression(4.0) + phi) * by_square, (Expression(2.0) - phi) * by_square};
}

PlaneMatrix translation_inertia(const Expression& factor, const Expression& length, const Expression& phi) {
  const Expression by_length = factor * length;
  const Expression by_square = by_length * length;
  return {factor * in_powers(phi, 13.0 / 35.0, 7.0 / 10.0, 1.0 / 3.0),
          by_length * in_powers(phi, 11.0 / 210.0, 11.0 / 120.0, 1.0 / 24.0),
          factor * in_powers(phi, 9.0 / 70.0, 3.0 / 10.0, 1.0 / 6.0),
          by_length * in_powers(phi, -13.0 / 420.0, -3.0 / 40.0, -1.0 / 24.0),
          by_square * in_powers(phi, 1.0 / 105.0, 1.0 / 60.0, 1.0 / 120.0),
          by_square * in_powers(phi, -1.0 / 140.0, -1.0 / 60.0, -1.0 / 120.0)};
}

PlaneMatrix rotation_inertia(const Expression& factor, const Expression& length, const Expression& phi) {
  const Expression by_length = factor * length;
  const Expression by_square = by_length * length;
  const Expression coupling = by_length * in_powers(phi, 1.0 / 10.0, -1.0 / 2.0, 0.0);
  return {Expression(6.0 / 5.0) * factor,
          coupling,
          Expression(-6.0 / 5.0) * factor,
          coupling,
          by_square * in_powers(phi, 2.0 / 15.0, 1.0 / 6.0, 1.0 / 3.0),
          by_square * in_powers(phi, -1.0 / 30.0, -1.0 / 6.0, 1.0 / 6.0)};
}

}  // namespace

Expression PlaneMatrix::operator()(std::size_t row, std::size_t column) const {
  const std::array<std::array<Expression, 4>, 4> rows{
      {{a, b, c, d}, {b, e, -d, f}, {c, -d, a, -b}, {d, f, -b, e}}};
  return rows[row][column];
}

PlaneMatrix operator+(const PlaneMatrix& one, const PlaneMatrix& other) {
  return {one.a + other.a, one.b + other.b, one.c + other.c,
          one.d + other.d, one.e + other.e, one.f + other.f};
}

Expression ShaftPiece::area() const {
  return Expression(std::numbers::pi / 4.0) * (square(outer) - square(inner));
}

Expression ShaftPiece::second_moment() const {
  return Expression(std::numbers::pi / 64.0) * (square(square(outer)) - square(square(inner)));
}

Expression cowper_shear_coefficient(const Expression& nu, const Expression& outer, const Expression& inner) {
  const Expression m2 = square(inner / outer);
  const Expression both = square(Expression(1.0) + m2);
  return Expression(6.0) * (Expression(1.0) + nu) * both /
         ((Expression(7.0) + Expression(6.0) * nu) * both + (Expression(20.0) + Expression(12.0) * nu) * m2);
}

ShaftMatrices shaft_matrices(const ShaftPiece& element) {
  const Expression& l = element.length;
  const Expression A = element.area(), I = element.second_moment();
  const Expression EI = element.E * I;
  const Expression phi = Expression(12.0) * EI / (element.shear * element.G * A * square(l));
  const Expression with_shear = Expression(1.0) + phi;
  return {bending_stiffness(EI / (square(l) * l * with_shear), l, phi),
          translation_inertia(element.density * A * l / square(with_shear), l, phi),
          rotation_inertia(element.density * I / (l * square(with_shear)), l, phi)};
}

}  // namespace eigentrail
