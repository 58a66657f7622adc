// Reads a model given by matrices: (M(p) s^2 + C(p) s + K(p)) z = 0, optionally with constraints A(p) x = 0;
// or E(p) s z = A(p) z.
#pragma once

#include <memory>

#include "eigentrail/model/build.hpp"

namespace eigentrail {

/// Reads [matrix_family] of a scene. Throws InputError for every fault in it.
std::unique_ptr<Model> read_matrix_family(const Scene& scene, const ModelRequest& request);

}  // namespace eigentrail
