// Reads the tables of a multibody scene and builds its model.
#pragma once

#include <memory>

#include "eigentrail/model/build.hpp"

namespace eigentrail {

std::unique_ptr<Model> read_multibody(const Scene& scene, const ModelRequest& request);

}  // namespace eigentrail
