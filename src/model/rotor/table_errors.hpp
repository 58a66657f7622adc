// Errors of eigenvalues that come from tables of coefficients: what their interpolants miss between the rows.
#pragma once

#include <memory>

#include "eigentrail/model/affine_family.hpp"
#include "eigentrail/model/sample_errors.hpp"

namespace eigentrail {

/// The errors of all tables of a family together; null if there are none, or if the argument of a table is
/// not a parameter itself, the same for all. The bounds of the tables add up.
std::unique_ptr<const SampleErrors> table_errors(const AffinePencil<Matrix>& pencil, Eigen::Index n);

}  // namespace eigentrail
