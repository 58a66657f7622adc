// The scene and the options that a loci file was made from.
#pragma once

#include <string>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/store/loci_file.hpp"

namespace eigentrail {

/// The file with the matrices of a scene, or the first table of a rotor, as the scene names it; empty if they
/// stand in the scene.
std::string file_of_matrices(const Scene& scene);

/// The scene and the options of the trace in the file. Matrices in a file of their own are read again. Throws
/// InputError if the stored text does not give the model of the stored points.
TraceSetup setup_of(const LociFile& loci);

}  // namespace eigentrail
