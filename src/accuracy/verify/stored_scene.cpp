#include "accuracy/verify/stored_scene.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "eigentrail/projection/route.hpp"

namespace eigentrail {
namespace {

/// The text that a key of a table has; empty if it has none.
std::string text_of(const Table& table, const char* key) {
  const Value* value = table.find(key);
  const auto* text = value != nullptr ? std::get_if<std::string>(&value->data) : nullptr;
  return text == nullptr ? "" : *text;
}

}  // namespace

std::string file_of_matrices(const Scene& scene) {
  constexpr std::array<std::pair<const char*, const char*>, 4> keys{
      {{"matrix_family", "file"}, {"sampled_family", "file"}, {"shaft", "stations"}, {"bearing", "table"}}};
  for (const auto& [name, key] : keys) {
    for (const Table* table : tables(scene, name)) {
      if (const std::string file = text_of(*table, key); !file.empty()) return file;
    }
  }
  return "";
}

namespace {

/// Where the scene of a loci file may be: its path as it was given to the trace, seen from here, from the
/// loci file's folder and from the folders above it; and beside the loci file.
std::vector<std::filesystem::path> places_of_scene(const std::string& scene, const std::string& loci) {
  namespace fs = std::filesystem;
  std::vector<fs::path> places{scene};
  std::error_code error;
  const fs::path file = fs::absolute(loci, error);
  if (error || fs::path(scene).is_absolute()) return places;
  for (fs::path folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    places.push_back(folder / scene);
    if (folder == folder.root_path()) break;
  }
  places.push_back(file.parent_path() / fs::path(scene).filename());
  return places;
}

/// If the scene has its matrices in a separate file, that file is read again. Its place is given only by the
/// loci file, which may come from an untrusted source. It is therefore read only if the scene file beside it
/// exists and has the text stored in the loci file. Throws InputError otherwise.
void find_matrices(Scene& scene, const std::string& path) {
  const std::string matrices = file_of_matrices(scene);
  if (matrices.empty()) return;
  const std::string given = scene.path;
  bool changed = false;
  for (const std::filesystem::path& place : places_of_scene(given, path)) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(place, error) || error) continue;
    std::ifstream stream(place, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    scene.path = place.string();
    if (text == scene.text) return;
    changed = true;
  }
  if (changed)
    throw InputError("it was made from another scene than " + given + " is now; the matrices in " + matrices +
                     " cannot be checked");
  throw InputError(
      "the matrices are in " + matrices + " beside " + given +
      ", which is neither in this folder nor beside the loci file or above it; go to the folder in "
      "which the trace was made, or put both beside the loci file");
}

}  // namespace

/// Messages name the loci file: errors in the scene and the options are those of the
/// stored text, not of a scene file that may have changed since.
TraceSetup setup_of(const LociFile& loci) try {
  OptionTexts options;
  for (const auto& [name, text] : loci.attributes) {
    const std::string key = name.starts_with("option_") ? name.substr(7) : "";
    if (!key.empty() && text != "auto") options.emplace_back(key, text);
  }
  Scene scene = parse_scene(loci.attribute("scene"), loci.attribute("scene_path"));
  find_matrices(scene, loci.path);
  TraceSetup setup = prepare_trace(std::move(scene), options);
  // The points of a projected family are at x = 0.
  if (large_family(*setup.model, setup.options) != nullptr) return setup;
  const bool same = setup.model->n_coordinates() == loci.equilibrium.cols() &&
                    setup.model->n_constraints() == loci.multiplier.cols();
  if (!same) {
    throw InputError(loci.path + ": its scene has " + std::to_string(setup.model->n_coordinates()) +
                     " coordinates and " + std::to_string(setup.model->n_constraints()) +
                     " constraints, its points " + std::to_string(loci.equilibrium.cols()) + " and " +
                     std::to_string(loci.multiplier.cols()));
  }
  return setup;
} catch (const InputError& error) {
  throw InputError(loci.path + ": cannot be solved afresh: " + error.what());
}

}  // namespace eigentrail
