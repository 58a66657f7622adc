// Bytes as blade files and main files of ElastoDyn and BeamDyn.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/blade_files.hpp"

EIGENTRAIL_FUZZ(blade) {
  const auto try_as = [bytes](auto parse) {
    try {
      (void)parse(bytes, "a.dat");
    } catch (const eigentrail::InputError&) {
    }
  };
  try_as(eigentrail::parse_elastodyn_blade);
  try_as(eigentrail::parse_elastodyn_rotor);
  try_as(eigentrail::parse_beamdyn_blade);
  try_as(eigentrail::parse_beamdyn_axis);
}
