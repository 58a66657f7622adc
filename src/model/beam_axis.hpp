// Nodes and elements of a beam before it is loaded.
#pragma once

#include "model/beam_table.hpp"

namespace eigentrail {

/// The n points and weights of Gauss-Legendre quadrature on [0, 1], exact for polynomials of degree 2 n - 1
/// (Golub & Welsch 1969).
std::vector<std::array<double, 2>> gauss_points(int n);

/// Lagrange polynomials of the equidistant nodes of an element of degree 1 or 2, and their derivatives, at xi
/// in [0, 1].
struct ShapeFunctions {
  std::vector<double> value, slope;
};
ShapeFunctions shape_functions(int degree, double xi);

/// Interpolates values at the stations of a table by cubics with continuous slope, those of the parabola
/// through three stations: weights of the stations for the value and for the derivative by s.
struct SmoothWeights {
  std::vector<double> value, slope;
};
SmoothWeights smooth_weights(const std::vector<double>& span, double s);

/// The unloaded beam. Elements have equal parts of the span; their nodes divide them evenly.
struct BeamAxis {
  int elements = 1;
  int degree = 2;
  bool straight = true;
  bool twisted = false;
  Expression length;                         ///< from end to end along a straight line
  std::vector<ExpressionVector> position;    ///< of every node, in the frame
  std::vector<ExpressionRotation> rotation;  ///< axes of its section; x along the beam
  /// The same seen along the chord: x from end to end, origin at the first. Shorter expressions if the ends
  /// depend on parameters.
  std::vector<ExpressionVector> local_position;
  std::vector<ExpressionRotation> local_rotation;

  int nodes() const { return elements * degree + 1; }
  /// Node with local index a of an element.
  std::size_t node(int element, std::size_t a) const {
    return static_cast<std::size_t>(element * degree) + a;
  }
  /// Arc length per xi.
  Expression stretch(int element, const ShapeFunctions& shape) const;
};

/// The axis between two ends, with the y axis of the sections as close to `y` as it may be, where the table
/// has no twist.
BeamAxis beam_axis(const BeamTable& table, int elements, int degree, const ExpressionVector& from,
                   const ExpressionVector& to, const ExpressionVector& y);

}  // namespace eigentrail
