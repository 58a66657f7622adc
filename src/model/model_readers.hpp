// Readers of scenes, one for each kind of model. They throw InputError for every fault of the scene.
#pragma once

#include "eigentrail/model/build.hpp"

namespace eigentrail {

/// A multibody scene.
std::unique_ptr<Model> read_multibody(const Scene& scene, const ModelRequest& request);

/// A rotor, a family of matrices: a scene with [[shaft]], [[disc]], [[bearing]] and [[support]].
std::unique_ptr<Model> read_rotor(const Scene& scene, const ModelRequest& request);

/// The tables that a scene with [[shaft]] may have beside [parameters], [trace] and [events].
const std::vector<std::string>& rotor_tables();

/// [matrix_family], a model given by matrices: (M(p) s^2 + C(p) s + K(p)) z = 0, optionally with constraints
/// A(p) x = 0; or E(p) s z = A(p) z.
std::unique_ptr<Model> read_matrix_family(const Scene& scene, const ModelRequest& request);

/// [sampled_family]; the values of the parameters at which the request has it checked must lie among the
/// samples.
std::unique_ptr<Model> read_sampled_family(const Scene& scene, const ModelRequest& request);

}  // namespace eigentrail
