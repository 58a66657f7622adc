// Bytes as blade files and main files of ElastoDyn and BeamDyn.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/blade_files.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto try_as = [text = eigentrail::fuzz::as_text(data, size)](auto parse) {
    try {
      (void)parse(text, "a.dat");
    } catch (const eigentrail::InputError&) {
    }
  };
  try_as(eigentrail::parse_elastodyn_blade);
  try_as(eigentrail::parse_elastodyn_rotor);
  try_as(eigentrail::parse_beamdyn_blade);
  try_as(eigentrail::parse_beamdyn_axis);
  return 0;
}
