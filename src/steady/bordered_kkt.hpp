// The KKT system with further unknowns u and as many equations: the traced parameter with the plane that it
// is sought on (steady/path_plane.hpp), or trimmed parameters with their conditions:
//
//     [ K    A^T  F ] [ dx ]   [ r ]
//     [ A    0    G ] [ dl ] = [ g ]
//     [ X    L    U ] [ du ]   [ h ]
//
// by the null-space method: dx = A+ (g - G du) + Q2 y and dl = (A^T)+ (r - K dx - F du) leave equations for y
// and du, of which one LU is taken. They are regular also where K itself is singular on the null space. Large
// models: steady/sparse_kkt.hpp.
#pragma once

#include <Eigen/LU>

#include "eigentrail/core/constraint_factorization.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// Columns and rows of q unknowns and equations.
struct KktBorder {
  Matrix force, constraint;  ///< F (n x q), G (m x q)
  Matrix x, lambda;          ///< X (q x n), L (q x m); empty L: zero
  Matrix unknown;            ///< U (q x q)

  /// The border of trimmed parameters.
  static KktBorder of(const TrimDerivatives& trim);

  /// The unknowns and equations of this border followed by one more unknown, with the columns (force,
  /// constraint, trim), and one more equation along . dx + of_others . du + of_unknown du' = h. An empty
  /// `of_others` is zero.
  KktBorder and_one(const Vector& of_force, const Vector& of_constraint, const Vector& along,
                    const Vector& of_others, double of_unknown) const;
};

class BorderedKkt {
 public:
  /// Dense, also for sparse K. Cost O((n - m)^3 + n^2 (n - m)).
  BorderedKkt(const SystemMatrix& K, const ConstraintFactorization& constraints, KktBorder border);

  void solve(const Vector& r, const Vector& g, const Vector& h, Vector& dx, Vector& dl, Vector& du) const;

  Eigen::Index n_unknowns() const { return border_.unknown.rows(); }
  Eigen::Index n_constraints() const { return border_.constraint.rows(); }

  /// Of the equations for y and du, with rows and columns of unit length. Near zero at a fold.
  /// The estimate of a singular matrix, whose zero pivots it leaves out, would say nothing.
  double reciprocal_condition() const { return lu_.isInvertible() ? lu_.rcond() : 0.0; }

  /// Sign of the determinant, which no choice of Q2 changes; 0 if a pivot is zero.
  int orientation() const;

  /// 2 x q, the components of du in the kernel of the scaled matrix, and those of the equations in that of
  /// its transpose, each the norm over the kernel. Zero if the matrix is regular.
  Matrix kernel_in_border() const;

 private:
  /// (A^T)+ (r - K dx - F du).
  Vector multipliers(const Vector& r, const Vector& dx, const Vector& du) const;

  SystemMatrix K_;
  ConstraintFactorization constraints_;
  KktBorder border_;
  Matrix follow_;     ///< n x q: -A+ G
  Matrix rows_of_x_;  ///< n x q: X^T
  Vector rows_, columns_;
  Matrix scaled_;
  Eigen::FullPivLU<Matrix> lu_;
};

}  // namespace eigentrail
