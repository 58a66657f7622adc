// Reads scenes from files.
#include <filesystem>
#include <fstream>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {
namespace {

/// Files of samples and loci files stand beside scenes and have similar names.
void reject_hdf5(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::string begin(signature.size(), ' ');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (stream && begin == signature)
    throw InputError(
        path +
        ": is an HDF5 file, no scene (TOML); 'eigentrail info' says what it holds. Matrices in it "
        "need a scene that names the file, with [sampled_family] or [matrix_family]");
}

}  // namespace

Scene read_scene(const std::string& path) {
  require_plain_file(path);
  reject_hdf5(path);
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size > limits::scene_bytes) {
    throw InputError(path + ": is " + std::to_string(size) + " bytes; a scene has at most " +
                     std::to_string(limits::scene_bytes) + "; put large matrices into HDF5");
  }
  return parse_scene(read_text(path, limits::scene_bytes), path);
}

}  // namespace eigentrail
