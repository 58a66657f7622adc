// Changes how modes are grouped: joins modes into a block, splits blocks, changes the chart.
#pragma once

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// One block from several pairs of the same chart, with their columns side by side. With `make_real`, a
/// complex pair is joined together with its conjugate. The result is not corrected.
InvariantPair join_pairs(const std::vector<const InvariantPair*>& parts, bool make_real);

/// A complex pair and its conjugate as a real block of twice the size.
InvariantPair with_conjugate(const InvariantPair& upper);

/// The part of a block that belongs to the eigenvalues with the indices `part` into `eigenvalues` (as
/// returned by pair_eigenvalues). The basis is an orthonormal Schur basis; it is real if the block is real
/// and the part is closed under conjugation.
InvariantPair part_of(const InvariantPair& pair, const ComplexVector& eigenvalues,
                      const std::vector<int>& part);

/// Eigenvalues of Lambda. For a real block they are exactly real or exactly conjugate.
ComplexVector pair_eigenvalues(const InvariantPair& pair);

/// Errors of these eigenvalues where the entries of the pencil have errors of `entries` times 2.2e-16 of
/// their magnitudes; `roots` are the pair's eigenvalues, in any order.
Vector eigenvalue_rounding(const InvariantPair& pair, const ComplexVector& roots, double entries);

/// The same block in the other chart: Lambda is replaced by its inverse.
InvariantPair in_other_chart(const InvariantPair& pair);

/// The block of the conjugate eigenvalues.
InvariantPair conjugated(const InvariantPair& pair);

}  // namespace eigentrail
