// Eigenvalues on a step with a count of what they cost: in files that are damaged, or made to, roots of a
// block change places so often that following them takes for ever.
#pragma once

#include <cstddef>

#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// step_eigenvalues of path_step.hpp. Adds to `work` one for every root of every polynomial that was solved.
ComplexVector counted_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                                  const ComplexVector& at_right, double t, std::size_t& work);

}  // namespace eigentrail
