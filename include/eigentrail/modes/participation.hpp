// Names of modes from the coordinates that take part in them, for models whose masses are not known.
//
// |y_i (P'(s) z)_i| with left and right eigenvectors y, z of P(s) = s^2 M + s C + K, as shares: the
// participation factors, which do not depend on the units of the coordinates (Perez-Arriaga, Verghese &
// Schweppe, IEEE Trans. Power Appar. Syst. 101, 1982).
#pragma once

#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Shares of the coordinates, n. `left`: y^T P(s) = 0. Where the eigenvalue is defective (`is_simple` is
/// false) or the product vanishes, |z_i|^2.
Vector participation(const ComplexVector& left, const ComplexVector& slope, const ComplexVector& right,
                     bool is_simple);

/// "1st flap progressive 71 %, drivetrain torsion 24 %": the motions that take part most (motion_names.hpp),
/// of an eigenvalue with Im s >= 0 and its right vector.
std::string largest_names(const Vector& shares, const ComplexVector& shape,
                          const std::vector<std::string>& names);

/// The same with the shares |z_i|^2 of a shape.
std::string largest_names(const ComplexVector& shape, const std::vector<std::string>& names);

/// The same for an eigenvalue s with its right vector; the left one costs an LU of size n. `s_ref`: magnitude
/// that counts as zero.
std::string name_by_participation(const Matrix& M, const Matrix& C, const Matrix& K, Complex s,
                                  const ComplexVector& right, double s_ref,
                                  const std::vector<std::string>& names);

/// Whether the coordinates have names of their own: not only x1, x2, ...
bool has_own_names(const std::vector<std::string>& names);

}  // namespace eigentrail
