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

  /// The entry at a row and a column from 0.
  Expression operator()(std::size_t row, std::size_t column) const;
};

PlaneMatrix operator+(const PlaneMatrix& one, const PlaneMatrix& other);

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

/// Matrices of an element in one plane.
struct ShaftMatrices {
  PlaneMatrix stiffness;
  PlaneMatrix translation;  ///< inertia of the displacements
  PlaneMatrix rotation;     ///< inertia of the rotations of the sections; the polar one is twice that
};
ShaftMatrices shaft_matrices(const ShaftPiece& element);

}  // namespace eigentrail
