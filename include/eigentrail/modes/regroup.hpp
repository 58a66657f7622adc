// Changing what is followed as a block: joining modes, taking blocks apart, changing the chart.
#pragma once

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// One block from several, all of one chart: columns side by side. A complex block that joins a real one
/// brings its conjugate along. The result is not yet corrected.
InvariantPair join_pairs(const std::vector<const InvariantPair*>& parts, bool make_real);

/// A complex block and its conjugate as a real block of twice the size.
InvariantPair with_conjugate(const InvariantPair& upper);

/// The part of a block that belongs to the eigenvalues with these indices into `eigenvalues` (as returned by
/// pair_eigenvalues): an orthonormal Schur basis, real where the part is closed under conjugation and the
/// block is real.
InvariantPair part_of(const InvariantPair& pair, const ComplexVector& eigenvalues,
                      const std::vector<int>& part);

/// Eigenvalues of Lambda, exactly conjugate or real for a real block.
ComplexVector pair_eigenvalues(const InvariantPair& pair);

/// The same block in the other chart: Lambda becomes its inverse.
InvariantPair in_other_chart(const InvariantPair& pair);

}  // namespace eigentrail
