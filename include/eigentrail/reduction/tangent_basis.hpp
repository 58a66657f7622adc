// Tangent basis T of the constraint manifold, A T = 0, and its power series along the path (seed paper, Eqs.
// 48, 67).
#pragma once

#include <cstdint>

#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {

/// T(h) with T(0) orthonormal. In the chart T(h) = T0 + Q1 X(h) it stays a null-space basis of A(h), though
/// not an orthonormal one beyond first order, which eigenvalues do not mind.
struct TangentBasis {
  MatrixSeries T;            ///< n x (n - rank); T[0] orthonormal
  bool is_identity = false;  ///< no constraints: T is the identity and is never multiplied
};

/// How the basis is chosen within the null space. Eigenvalues may not depend on it.
enum class BasisChoice {
  aligned,  ///< closest to the previous point's basis: reduced vectors change smoothly
  random    ///< turned by a random orthogonal matrix: for tests
};

/// T(0) = Q2 turned towards `previous` (n x (n - rank); ignored when empty or of another size), which keeps
/// reduced coordinates continuous from point to point. With a sparse factorization it is computed from
/// `previous` alone, as long as no direction of it turns by more than about 80 degrees.
TangentBasis tangent_basis(const ConstraintFactorization& constraints, const Matrix& previous);

/// Turns the basis by a random orthogonal matrix drawn from `seed`.
void randomize_basis(TangentBasis& basis, std::uint64_t seed);

/// Fills T_1 .. T_order from the series of A:  T_k = -A+ sum_{j=1..k} A_j T_{k-j}  (order 1 is Eq. 67). One
/// pseudo-inverse product per order with the factorization of A_0.
void differentiate_basis(const ConstraintFactorization& constraints, const SystemSeries& A, int order,
                         TangentBasis& basis);

}  // namespace eigentrail
