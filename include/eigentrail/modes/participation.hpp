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

/// A motion and its share in a mode.
struct MotionShare {
  std::string name;
  double share = 0.0;
};

/// The motions of a mode, by descending share. `names`: of n coordinates or states; `shares`: n, adding up to
/// one; `shape`: n, of the eigenvalue with Im s >= 0, for motions as exp(s t).
///
/// * "X velocity" and "X rate" are parts of the motion X, if there is one.
/// * "X cosine" and "X sine" are multiblade coordinates, q_k = c cos(psi_k) + s sin(psi_k), of which |c + i
/// s|
///   belongs to a wave that turns with the rotor, "X progressive", and |c - i s| to one that turns against
///   it, "X regressive" (Johnson, Helicopter Theory, Sect. 8-4; Bir, NREL/CP-500-42553, 2008). "cosine 2" and
///   "sine 2" likewise. Of real eigenvalues, in which nothing turns, they stay apart.
std::vector<MotionShare> motion_shares(const std::vector<std::string>& names, const Vector& shares,
                                       const ComplexVector& shape);

/// Shares of the coordinates, n. `left`: y^T P(s) = 0. Where the eigenvalue is defective (`is_simple` is
/// false) or the product vanishes, |z_i|^2.
Vector participation(const ComplexVector& left, const ComplexVector& slope, const ComplexVector& right,
                     bool is_simple);

/// "1st flap progressive 71 %, drivetrain torsion 24 %": the motions that take part most (motion_shares),
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
