// Element of a shaft: a Timoshenko beam with two nodes, uniform along its length, circular in section.
//
// Its shape functions are those of a beam that bends under forces at its ends only: cubic in the
// displacement, quadratic in the rotation of the section, with the shear parameter phi = 12 E I / (k G A
// l^2). They are exact for such loads, so nothing locks, and for phi = 0 they are those of Euler and
// Bernoulli. Stiffness and inertia (of translation and of rotation) are consistent with them (Przemieniecki,
// Theory of Matrix Structural Analysis, 1968, Sects. 5.6 and 11.5; Friswell, Penny, Garvey & Lees, Dynamics
// of Rotating Machines, 2010, Sect. 5.4).
#pragma once

#include <array>

#include "eigentrail/scene/expression.hpp"

namespace eigentrail {

/// Matrix of an element in one plane. Its freedoms are displacement u and slope t at either end, u1, t1, u2,
/// t2:
///
///     |  a   b   c   d |
///     |  b   e  -d   f |
///     |  c  -d   a  -b |
///     |  d   f  -b   e |
struct PlaneMatrix {
  Expression a, b, c, d, e, f;
};

/// What two inner freedoms of an element add to such a matrix: rows of the first and the second one, behind
/// those of the ends.
///
///     |  a   b   a  -b   p   0 |
///     |  c   d  -c   d   0   q |
struct InnerRows {
  Expression a, b, c, d, p, q;
};

/// The whole matrix: freedoms u1, t1, u2, t2 and the inner ones.
using ElementMatrix = std::array<std::array<Expression, 6>, 6>;
ElementMatrix element_matrix(const PlaneMatrix& ends, const InnerRows& inner);

ElementMatrix operator+(ElementMatrix one, const ElementMatrix& other);

/// A uniform piece of shaft, SI units.
struct ShaftPiece {
  Expression length;        ///< m
  Expression outer, inner;  ///< diameters, m
  Expression E, G;          ///< moduli, Pa
  Expression density;       ///< kg/m^3
  Expression shear;         ///< shear coefficient k of the section

  Expression area() const;           ///< A, m^2
  Expression second_moment() const;  ///< I about a diameter, m^4
};

/// Shear coefficient of a hollow circular section (Cowper, J. Appl. Mech. 33, 1966, p. 335, Eqs. 17 and 18),
/// with m = inner / outer:
///
///     k = 6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2)
Expression cowper_shear_coefficient(const Expression& nu, const Expression& outer, const Expression& inner);

/// Matrices of an element in one plane: stiffness, inertia of the displacements, and inertia of the rotations
/// of the sections, whose polar one is twice that.
template <class Rows>
struct ShaftMatrices {
  Rows stiffness, translation, rotation;
};
ShaftMatrices<PlaneMatrix> end_matrices(const ShaftPiece& element);

/// The same for the inner freedoms, with the displacement and the rotation (x = z / l from 0 to 1)
///
///     first    u = (x^2 (1-x)^2 + phi x (1-x)) / (1 + phi),   t = 2 x (1-x) (1-2x) / (l (1 + phi))
///     second   u = -l x (1-x) (1-2x) / 6,                     t = x (1-x)
///
/// The first is the static shape under a load that is spread evenly, the second that under a spread moment;
/// both vanish at the ends. Without them the shear strain is constant in an element, and where elements are
/// shorter than thick the error of frequencies falls with the square of their length; with them with the
/// fourth power.
ShaftMatrices<InnerRows> inner_matrices(const ShaftPiece& element);

}  // namespace eigentrail
