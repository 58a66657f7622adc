#include "accuracy/verify/comparisons.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/route.hpp"

namespace eigentrail {
namespace {

Event event_of(const LociFile& loci, const LociEvent& stored) {
  const EventKindInfo* kind = find_event_kind(stored.kind);
  if (kind == nullptr) throw InputError(loci.path + ": has a special point of unknown kind " + stored.kind);
  Event event{.kind = kind->kind,
              .p = stored.parameter,
              .s = stored.s,
              .direction = stored.direction,
              .value = stored.value,
              .node = stored.node};
  std::istringstream numbers(stored.modes);
  for (std::string number; std::getline(numbers, number, ';');)
    event.modes.push_back(std::atoi(number.c_str()) - 1);
  const auto exists = [&](int mode) { return mode >= 0 && mode < static_cast<int>(loci.modes.size()); };
  const bool fits = std::all_of(event.modes.begin(), event.modes.end(), exists);
  if (!fits)
    throw InputError(loci.path + ": the modes of " + event_line(event) + " do not fit the other datasets");
  return event;
}

}  // namespace

bool CheckedFile::is_meeting(std::size_t number) const {
  constexpr double near = 1e-6;       // share of the steps on both sides
  constexpr double near_turn = 1e-5;  // share of the range, where the stiffness is singular
  const std::size_t before = number > 0 ? number - 1 : 0;
  const std::size_t behind = std::min(number + 1, loci.n_nodes() - 1);
  const double p = loci.p[number];
  const double length = std::abs(loci.p[behind] - p) + std::abs(p - loci.p[before]);
  const double range = loci.highest() - loci.lowest();
  return std::any_of(events.begin(), events.end(), [&](const Event& event) {
    const bool meets = event.kind == EventKind::collision || event.kind == EventKind::crossing;
    const bool turns = is_static(event.kind);
    const double distance = std::abs(event.p - p);
    return (meets && distance <= near * length) || (turns && distance <= near_turn * range);
  });
}

std::vector<std::size_t> CheckedFile::plain_nodes(std::size_t most) const {
  std::vector<std::size_t> plain;
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    if (!is_meeting(node)) plain.push_back(node);
  }
  const std::size_t count = std::min(plain.size(), most);
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < count; ++i) nodes.push_back(plain[i * plain.size() / count]);
  return nodes;
}

std::string CheckedFile::at(double p) const {
  return loci.parameter + " = " + exact_text(p);
}

std::string CheckedFile::mode_at(Eigen::Index mode, double p) const {
  return loci.modes[static_cast<std::size_t>(mode)] + " at " + at(p);
}

CheckedFile checked_file(const LociFile& loci, const TraceSetup& setup) {
  CheckedFile file{loci, setup, {setup.options.tolerance, loci.number("reference")}, {}};
  for (const LociEvent& event : loci.events) file.events.push_back(event_of(loci, event));
  return file;
}

std::string file_of_matrices(const Scene& scene) {
  constexpr std::array<std::pair<const char*, const char*>, 4> keys{
      {{"matrix_family", "file"}, {"sampled_family", "file"}, {"shaft", "stations"}, {"bearing", "table"}}};
  for (const auto& [name, key] : keys) {
    for (const Table* table : tables(scene, name)) {
      if (const auto* file = entry_as<std::string>(*table, key); file != nullptr && !file->empty())
        return *file;
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
