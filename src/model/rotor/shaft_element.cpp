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

/// What the matrices of an element are made of.
struct ElementProperties {
  Expression l, A, EI;
  Expression rotary;  ///< moment of inertia of the sections, rho I
  Expression phi, with_shear;
};

ElementProperties properties(const ShaftPiece& element) {
  const Expression& l = element.length;
  const Expression A = element.area(), I = element.second_moment();
  const Expression EI = element.E * I;
  const Expression phi = Expression(12.0) * EI / (element.shear * element.G * A * square(l));
  return {l, A, EI, element.density * I, phi, Expression(1.0) + phi};
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

ElementMatrix element_matrix(const PlaneMatrix& ends, const InnerRows& inner) {
  const auto& [a, b, c, d, e, f] = ends;
  const Expression none;
  return {{{a, b, c, d, inner.a, inner.c},
           {b, e, -d, f, inner.b, inner.d},
           {c, -d, a, -b, inner.a, -inner.c},
           {d, f, -b, e, -inner.b, inner.d},
           {inner.a, inner.b, inner.a, -inner.b, inner.p, none},
           {inner.c, inner.d, -inner.c, inner.d, none, inner.q}}};
}

ElementMatrix operator+(ElementMatrix one, const ElementMatrix& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < one.size(); ++j) one[i][j] = one[i][j] + other[i][j];
  }
  return one;
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

ShaftMatrices<PlaneMatrix> end_matrices(const ShaftPiece& element) {
  const auto [l, A, EI, rotary, phi, with_shear] = properties(element);
  const Expression square_of_shear = square(with_shear);
  return {bending_stiffness(EI / (square(l) * l * with_shear), l, phi),
          translation_inertia(element.density * A * l / square_of_shear, l, phi),
          rotation_inertia(rotary / (l * square_of_shear), l, phi)};
}

ShaftMatrices<InnerRows> inner_matrices(const ShaftPiece& element) {
  const auto [l, A, EI, rotary, phi, with_shear] = properties(element);
  const Expression square_of_shear = square(with_shear), square_of_length = square(l);
  const Expression mass = element.density * A * l;
  const Expression none;
  return {{none, none, none, none,
           EI * (Expression(0.8) + Expression(4.0) * phi) / (square_of_length * l * square_of_shear),
           EI / (Expression(3.0) * l) + element.shear * element.G * A * l / Expression(36.0)},
          {mass * in_powers(phi, 1.0 / 60.0, 1.0 / 10.0, 1.0 / 12.0) / square_of_shear,
           mass * l * in_powers(phi, 1.0 / 280.0, 17.0 / 840.0, 1.0 / 60.0) / square_of_shear,
           mass * l * in_powers(phi, -1.0 / 280.0, -1.0 / 360.0, 0.0) / with_shear,
           mass * square_of_length * Expression(-1.0 / 2520.0) / with_shear,
           mass * in_powers(phi, 1.0 / 630.0, 1.0 / 70.0, 1.0 / 30.0) / square_of_shear,
           mass * square_of_length * Expression(1.0 / 7560.0)},
          {none, rotary * Expression(1.0 / 30.0) / with_shear, rotary * Expression(-1.0 / 5.0) / with_shear,
           rotary * l * in_powers(phi, -1.0 / 60.0, 1.0 / 12.0, 0.0) / with_shear,
           rotary * Expression(2.0 / 105.0) / (l * square_of_shear), rotary * l * Expression(1.0 / 30.0)}};
}

}  // namespace eigentrail
