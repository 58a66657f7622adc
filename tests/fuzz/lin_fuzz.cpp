// Bytes as a linearization file of OpenFAST.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/lin_file.hpp"
#include "import/openfast_states.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const eigentrail::LinFile file =
        eigentrail::parse_lin_file(eigentrail::fuzz::as_text(data, size), "a.lin");
    for (const eigentrail::LinQuantity& state : file.states)
      (void)eigentrail::openfast_state(state.description);
  } catch (const eigentrail::InputError&) {
  }
  return 0;
}
