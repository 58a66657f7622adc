#include "eigentrail/store/part_file.hpp"

#include <algorithm>
#include <filesystem>

#include "core/archive.hpp"
#include "core/fingerprint.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/core/version.hpp"
#include "store/differences.hpp"
#include "store/saved_pieces.hpp"

namespace eigentrail {
namespace {

/// Adds name and contents of the files that a value of a scene names by a key `file`.
void add_files(const Table& table, const std::filesystem::path& folder, std::string& found) {
  for (const auto& [key, value] : table.entries) {
    if (const auto* inner = std::get_if<Table>(&value.data)) add_files(*inner, folder, found);
    if (const auto* items = std::get_if<Array>(&value.data)) {
      for (const Value& item : *items) {
        if (const auto* inner = std::get_if<Table>(&item.data)) add_files(*inner, folder, found);
      }
    }
    const auto* name = key == "file" ? std::get_if<std::string>(&value.data) : nullptr;
    if (name == nullptr) continue;
    found += *name + " " + std::to_string(fingerprint(bytes_of_file((folder / *name).string()))) + "\n";
  }
}

std::string part_name(const Part& part) {
  return "part " + std::to_string(part.number) + " of " + std::to_string(part.count);
}

std::string option_of(int number, int count) {
  return "--part " + std::to_string(number) + "/" + std::to_string(count);
}

void check_same_run(const PartFile& first, const PartFile& other) {
  const auto refuse = [&](const std::string& reason) {
    throw InputError(other.path + ": belongs to another run than " + first.path + ": " + reason);
  };
  SharedRun of_first = first.run;
  of_first.part = other.run.part;
  const std::string found = changes(of_first.all_settings(), other.run.all_settings());
  if (!found.empty()) refuse(found);
  if (first.run.part->count != other.run.part->count)
    throw InputError(other.path + ": is " + part_name(*other.run.part) + ", but " + first.path + " is " +
                     part_name(*first.run.part) + "; merge the parts of one division");
  if (first.run.n_pieces != other.run.n_pieces) refuse("another number of pieces");
}

[[noreturn]] void refuse_missing(const std::vector<int>& missing, int count) {
  constexpr std::size_t most_named = 5;
  const auto named = first_items(missing, most_named);
  std::string numbers = joined(named, ", ", [](int number) { return std::to_string(number); });
  std::string options = joined(named, ", ", [count](int number) { return option_of(number, count); });
  if (missing.size() > most_named) {
    numbers += " and " + std::to_string(missing.size() - most_named) + " more";
    options += ", ...";
  }
  const bool one = missing.size() == 1;
  throw InputError((one ? "part " : "parts ") + numbers + " of " + std::to_string(count) +
                   (one ? " is missing" : " are missing") + "; give all files, or repeat the command with " +
                   options);
}

}  // namespace

std::optional<std::string> SharedRun::setting(const std::string& label) const {
  const auto found = std::ranges::find_if(settings, [&](const auto& one) { return one.first == label; });
  return found == settings.end() ? std::nullopt : std::optional(found->second);
}

Settings SharedRun::all_settings() const {
  Settings all = settings;
  all.emplace_back("command", command);
  if (part) all.emplace_back("--part", std::to_string(part->number) + "/" + std::to_string(part->count));
  return all;
}

Settings settings_of(const Scene& scene) {
  std::string files;
  add_files(scene.root, std::filesystem::path(scene.path).parent_path(), files);
  return {{"version", version()}, {"scene", scene.text}, {"files of the scene", files}};
}

PartFile read_part_file(const std::string& path) {
  const std::string bytes = bytes_of_file(path);
  const InputError damaged(path + ": is damaged or incomplete; repeat this part");
  if (!bytes.starts_with(pieces_format))
    throw InputError(path +
                     ": is no part of a run, or damaged; expected a file that a command wrote with --part");
  try {
    SavedPieces saved = saved_pieces(bytes);
    const SharedRun& run = saved.run;
    if (const std::string written = run.setting("version").value_or(version()); written != version())
      throw InputError(path + ": was written by eigentrail " + printable(written) + ", this is " + version() +
                       "; merge with the version that wrote the parts");
    if (!run.part || saved.size != bytes.size() || saved.pieces.size() != run.pieces().size()) throw damaged;
    return {path, run, saved.blas_kernel, std::move(saved.pieces)};
  } catch (const ArchiveError&) {
    throw damaged;
  }
}

PiecesByName joined(const std::vector<PartFile>& parts) {
  if (parts.empty()) throw InputError("merge: expected the files of the parts");
  const PartFile& first = parts.front();
  std::vector<const PartFile*> by_number(static_cast<std::size_t>(first.run.part->count), nullptr);
  for (const PartFile& file : parts) {
    check_same_run(first, file);
    const PartFile*& place = by_number[static_cast<std::size_t>(file.run.part->number - 1)];
    if (place != nullptr)
      throw InputError(file.path + ": is " + part_name(*file.run.part) + ", as " + place->path +
                       " is; give each part once");
    place = &file;
  }
  std::vector<int> missing;
  for (int i = 0; i < first.run.part->count; ++i) {
    if (by_number[static_cast<std::size_t>(i)] == nullptr) missing.push_back(i + 1);
  }
  if (!missing.empty()) refuse_missing(missing, first.run.part->count);
  PiecesByName pieces;
  for (const PartFile* file : by_number) pieces.insert(file->pieces.begin(), file->pieces.end());
  return pieces;
}

}  // namespace eigentrail
