// Reads a rotor: a scene with [[shaft]], [[disc]], [[bearing]] and [[support]].
#pragma once

#include <memory>
#include <vector>

#include "eigentrail/model/build.hpp"

namespace eigentrail {

/// The tables that a scene with [[shaft]] may have beside [parameters], [trace] and [events].
const std::vector<std::string>& rotor_tables();

/// Builds the family of matrices that a rotor is. Throws InputError for every fault of the scene.
std::unique_ptr<Model> read_rotor(const Scene& scene, const ModelRequest& request);

}  // namespace eigentrail
