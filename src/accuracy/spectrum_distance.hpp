// How far eigenvalues are from those of a spectrum, as the tolerance of a trace counts it.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// Whether each mode is part of a block of several on the step.
std::vector<bool> in_blocks(const PathStep& step, std::size_t n_modes);

/// A spectrum given by one member of each complex pair with the other members added.
std::vector<Complex> with_conjugates(const std::vector<Complex>& spectrum);

/// Distance of every value from the eigenvalue assigned to it, one to one, relative to max(|s|, reference);
/// zero for values that are NaN (modes that do not exist). More values than eigenvalues: those left over are
/// infinitely far. `spectrum` and the values hold one member of each complex pair, either of them.
///
/// Near a meeting single eigenvalues are as uncertain as roots of a polynomial there, and what a trace
/// promises are the functions of the block. An error of a mode `in_block` (one entry per value) counts as the
/// error of those: weighed by its distance to the others, where that is below a tenth of abs(s). O(n^3).
Vector distances_from_spectrum(const ComplexVector& values, const std::vector<bool>& in_block,
                               const std::vector<Complex>& spectrum, double reference);

/// The same for values that hold both members of complex pairs, all as in blocks.
Vector distances_from_members(const ComplexVector& values, const std::vector<Complex>& spectrum,
                              double reference);

}  // namespace eigentrail
