// Eigenvalues on a step with a count of the work. In a damaged or malicious file the roots of a block may
// change places so often that following them would take very long; the count allows a limit.
#pragma once

#include <cstddef>

#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// step_eigenvalues of eigentrail/continuation/path_step.hpp. Adds to `work` the number of roots of every
/// block that was solved for.
ComplexVector counted_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                                  const ComplexVector& at_right, double t, std::size_t& work);

}  // namespace eigentrail
