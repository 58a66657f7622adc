// Bytes as a scene: TOML, options of the trace, model.
#include "eigentrail/continuation/trace_options.hpp"
#include "fuzz/entry.hpp"

using namespace eigentrail;

EIGENTRAIL_FUZZ(scene) {
  try {
    const TraceSetup setup = prepare_trace(parse_scene(std::string(bytes), "fuzz/scene.toml"), {});
    (void)setup.model->initial_guess(setup.scene.parameters.declared_values());
    (void)setup.model->structure(setup.traced());
  } catch (const InputError&) {
  }
}
