// Bytes as a scene: TOML, options of the trace, model.
#include "eigentrail/continuation/trace_options.hpp"
#include "fuzz/entry.hpp"

using namespace eigentrail;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const TraceSetup setup =
        prepare_trace(parse_scene(std::string(fuzz::as_text(data, size)), "fuzz/scene.toml"), {});
    (void)setup.model->initial_guess(setup.scene.parameters.declared_values());
    (void)setup.model->structure(setup.traced());
  } catch (const InputError&) {
  }
  return 0;
}
