// Precompiled header: what most files include is parsed once per target, and the products and decompositions
// that most of them use are compiled once. No file may depend on it: builds without it (preset dev) give the
// same program and only take longer.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

// What is compiled once, in the file beside each list.
#define EIGENTRAIL_COMPILED_ONCE extern template
#include "core/product_kernels.inc"

#include "core/precompiled_products.hpp"

#include "core/decompositions_complex.inc"
#include "core/decompositions_eigenvalues.inc"
#include "core/decompositions_lu.inc"
#include "core/decompositions_qr.inc"
#undef EIGENTRAIL_COMPILED_ONCE
