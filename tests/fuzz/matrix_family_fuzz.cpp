// Bytes as the HDF5 file of a [matrix_family].
#include "eigentrail/continuation/trace_options.hpp"
#include "fuzz/entry.hpp"
#include "fuzz/scratch_folder.hpp"

using namespace eigentrail;

namespace {

constexpr const char* scene = R"(
[matrix_family]
file = "family.h5"
[trace]
parameter = "p"
from = 0
to = 1
)";

}  // namespace

EIGENTRAIL_FUZZ(matrix_family) {
  static const fuzz::ScratchFolder folder;
  folder.write("family.h5", bytes);
  try {
    const TraceSetup setup = prepare_trace(parse_scene(scene, folder.file("scene.toml")), {});
    (void)setup.model->initial_guess(setup.scene.parameters.declared_values());
    (void)setup.model->structure(setup.traced());
  } catch (const InputError&) {
  }
}
