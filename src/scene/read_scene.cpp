// Reads scenes from files.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {
namespace {

/// Files of samples and loci files stand beside scenes and have similar names.
void reject_hdf5(std::istream& stream, const std::string& path) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::string begin(signature.size(), ' ');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (stream && begin == signature)
    throw InputError(
        path +
        ": is an HDF5 file, no scene (TOML); 'eigentrail info' says what it holds. Matrices in it "
        "need a scene that names the file, with [sampled_family] or [matrix_family]");
  stream.clear();
  stream.seekg(0);
}

}  // namespace

Scene read_scene(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError(path + ": cannot be read (" + error.message() + ")");
  std::ifstream stream(path, std::ios::binary);
  reject_hdf5(stream, path);
  if (size > limits::scene_bytes) {
    throw InputError(path + ": is " + std::to_string(size) + " bytes; a scene has at most " +
                     std::to_string(limits::scene_bytes) + "; put large matrices into HDF5");
  }
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(path + ": cannot be read");
  return parse_scene(std::move(text), path);
}

}  // namespace eigentrail
