// Basis T of the tangent space of the constraint manifold, A T = 0, and its power series along the path (seed
// paper, Eqs. 48, 67).
#pragma once

#include <cstdint>
#include <optional>

#include "eigentrail/core/constraint_factorization.hpp"
#include "eigentrail/model/projection.hpp"
#include "eigentrail/reduction/independent_parts.hpp"

namespace eigentrail {

/// T(h) with orthonormal T(0). The series T(h) = T0 + Q1 X(h) remains a basis of the null space of A(h).
/// Beyond first order it is not orthonormal; the eigenvalues do not depend on that.
struct TangentBasis {
  MatrixSeries T;            ///< n x (n - rank); T[0] orthonormal
  bool is_identity = false;  ///< no constraints: T is the identity, and multiplications by it are skipped
  /// Set where the equations fall apart or are balanced in constant coordinates: T = parts->right.
  std::shared_ptr<const IndependentParts> parts = {};
  /// With parts and constraints that change along the path: the series of parts->left, as T is that of
  /// parts->right. Else empty.
  MatrixSeries left = {};

  /// Reduced coordinates of physical vectors within the tangent space: T^T V, or those of one part.
  ComplexMatrix coordinates(const ComplexMatrix& V, int part) const;
  /// T(0) times reduced vectors (of one part, or of one of its copies, counted from 1).
  ComplexMatrix shapes(const ComplexMatrix& Z, int part, int copy = 0) const;
};

/// The basis of constant coordinates.
TangentBasis basis_of(std::shared_ptr<const IndependentParts> parts);

/// Number of copies of a part.
int n_copies(const TangentBasis& basis, int part);

/// The basis in which a copy of a part, counted from 1, is in the place of the part.
TangentBasis basis_with_copy(const TangentBasis& basis, int part, int copy);

/// How the basis is chosen within the null space. The eigenvalues do not depend on the choice.
enum class BasisChoice {
  aligned,  ///< closest to the basis of the previous point: reduced vectors change smoothly
  random    ///< rotated by a random orthogonal matrix, for tests
};

/// T(0) = Q2, rotated to be close to `previous` (n x (n - rank); ignored if empty or of another size), so
/// that reduced coordinates are continuous from point to point. With a sparse factorization T(0) is computed
/// from `previous` without Q2, unless a direction of it turns by more than about 80 degrees.
TangentBasis tangent_basis(const ConstraintFactorization& constraints, const Matrix& previous);

/// Rotates the basis by a random orthogonal matrix drawn from `seed`.
void randomize_basis(TangentBasis& basis, std::uint64_t seed);

/// Computes T_1 ... T_order from the series of A: T_k = -A+ sum_{j=1..k} A_j T_{k-j} (order 1 is Eq. 67). One
/// product with the pseudo-inverse per order, with the factorization of A_0.
void differentiate_basis(const ConstraintFactorization& constraints, const SystemSeries& A, int order,
                         TangentBasis& basis);

/// Where the linearized equations are restricted to few motions: T(0) spans the motions v with A v = 0
/// that differ from one of `motions` by B^T y, B the constraints at the reference, that is, v = (I - B^T (A
/// B^T)^-1 A) u. A motion v that is allowed here is there if and only if its part that was allowed at the
/// reference is one of `motions`. T(0) depends smoothly on the place alone. Empty if the constraints have
/// turned by about 90 degrees since the reference. Cost: a sparse LU of size m and O(n k^2).
std::optional<TangentBasis> restricted_basis(const Motions& motions, const SystemMatrix& A,
                                             const ConstraintFactorization& constraints);

}  // namespace eigentrail
