// Bytes as a linearization file of OpenFAST.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/lin_file.hpp"
#include "import/openfast_states.hpp"

EIGENTRAIL_FUZZ(lin) {
  try {
    const eigentrail::LinFile file = eigentrail::parse_lin_file(bytes, "a.lin");
    for (const eigentrail::LinQuantity& state : file.states)
      (void)eigentrail::openfast_state(state.description);
  } catch (const eigentrail::InputError&) {
  }
}
