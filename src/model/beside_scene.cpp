#include "model/beside_scene.hpp"

#include <algorithm>
#include <filesystem>

namespace eigentrail {

std::string beside_scene(const Scene& scene, TableReader& table, const std::string& key) {
  namespace fs = std::filesystem;
  const std::string name = table.text(key);
  const fs::path path(name);
  const bool leaves = std::any_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
  if (path.is_absolute() || leaves || name.empty()) {
    table.fail(key, "expected a file in the scene's folder or below it, found \"" + name + "\"");
  }
  const fs::path beside = fs::path(scene.path).parent_path();
  std::error_code error;
  const fs::path folder = fs::canonical(beside.empty() ? "." : beside, error);
  const fs::path file = error ? fs::path() : fs::canonical(folder / path, error);
  // A missing file is reported when it is opened.
  const bool within =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
  if (!error && !within) {
    table.fail(key, "\"" + name + "\" leads out of the scene's folder, to " + file.string() +
                        "; expected a file in the folder or below it");
  }
  return (beside / path).string();
}

Hdf5File open_beside_scene(const Scene& scene, TableReader& table) {
  const auto in_memory = scene.files.find(table.text("file"));
  if (in_memory == scene.files.end()) return Hdf5File::open(beside_scene(scene, table));
  return Hdf5File::from_image(in_memory->first, *in_memory->second);
}

}  // namespace eigentrail
