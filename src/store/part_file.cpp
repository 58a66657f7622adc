#include "eigentrail/store/part_file.hpp"

#include <algorithm>
#include <filesystem>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "core/fingerprint.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/core/version.hpp"
#include "store/differences.hpp"
#include "store/marked_data.hpp"

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
  const std::string found = changes(first.run.all_settings(), other.run.all_settings());
  if (!found.empty()) refuse(found);
  if (first.part.count != other.part.count)
    throw InputError(other.path + ": is " + part_name(other.part) + ", but " + first.path + " is " +
                     part_name(first.part) + "; merge the parts of one division");
  if (first.run.n_pieces != other.run.n_pieces) refuse("another number of pieces");
}

[[noreturn]] void refuse_missing(const std::vector<int>& missing, int count) {
  constexpr std::size_t most_named = 5;
  std::string numbers, options;
  for (std::size_t i = 0; i < std::min(missing.size(), most_named); ++i) {
    numbers += (i > 0 ? ", " : "") + std::to_string(missing[i]);
    options += (i > 0 ? ", " : "") + option_of(missing[i], count);
  }
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
  const auto found =
      std::find_if(settings.begin(), settings.end(), [&](const auto& one) { return one.first == label; });
  return found == settings.end() ? std::nullopt : std::optional(found->second);
}

Settings SharedRun::all_settings() const {
  Settings all = settings;
  all.emplace_back("command", command);
  return all;
}

Settings settings_of(const Scene& scene) {
  std::string files;
  add_files(scene.root, std::filesystem::path(scene.path).parent_path(), files);
  return {{"version", version()}, {"scene", scene.text}, {"files of the scene", files}};
}

void write_part(const PartFile& file, Existing existing) {
  Hdf5Writer head = Hdf5Writer::in_memory(file.path);
  head.set_attribute("format", part_format);
  head.set_attribute("schema_version", std::int64_t{part_schema_version});
  head.set_attribute("program_version", version());
  head.set_attribute("command", file.run.command);
  head.set_attribute("scene_path", file.run.scene_path);
  head.set_attribute("part", std::int64_t{file.part.number});
  head.set_attribute("part_count", std::int64_t{file.part.count});
  const std::string pieces = packed(file.run.command, file.run.scene_path, file.run.settings,
                                    static_cast<std::uint64_t>(file.run.n_pieces), file.part.number,
                                    file.part.count, file.pieces, blas_kernel());
  const std::string image = head.image(), marked = marked_data(pieces_mark, image, pieces);
  write_durably(file.path, {image, marked}, existing);
}

PartFile read_part_file(const std::string& path) {
  const std::string bytes = bytes_of_file(path);
  const InputError damaged(path + ": is damaged or incomplete; repeat this part");
  const auto marked = take_apart(pieces_mark, bytes, damaged);
  if (!marked) {
    if (may_be_replaced(path, part_format)) throw damaged;
    throw InputError(path +
                     ": is no part of a run, or damaged; expected a file that a command wrote with --part");
  }
  // The first bytes of the archive are the same in all versions; the version is checked before the rest.
  PartFile file;
  file.path = path;
  std::uint64_t n_pieces = 0;
  try {
    ArchiveReader archive(marked->data);
    archive(file.run.command, file.run.scene_path, file.run.settings);
    for (const auto& [label, text] : file.run.settings) {
      if (label == "version" && text != version())
        throw InputError(path + ": was written by eigentrail " + printable(text) + ", this is " + version() +
                         "; merge with the version that wrote the parts");
    }
    archive(n_pieces, file.part.number, file.part.count, file.pieces, file.blas_kernel);
    archive.finish();
  } catch (const ArchiveError&) {
    throw damaged;
  }
  file.run.n_pieces = static_cast<std::size_t>(n_pieces);
  const Part& part = file.part;
  if (part.number < 1 || part.number > part.count ||
      file.pieces.size() != part.pieces(file.run.n_pieces).size())
    throw damaged;
  return file;
}

std::vector<std::string> joined(const std::vector<PartFile>& parts) {
  if (parts.empty()) throw InputError("merge: expected the files of the parts");
  const PartFile& first = parts.front();
  std::vector<const PartFile*> by_number(static_cast<std::size_t>(first.part.count), nullptr);
  for (const PartFile& file : parts) {
    check_same_run(first, file);
    const PartFile*& place = by_number[static_cast<std::size_t>(file.part.number - 1)];
    if (place != nullptr)
      throw InputError(file.path + ": is " + part_name(file.part) + ", as " + place->path +
                       " is; give each part once");
    place = &file;
  }
  std::vector<int> missing;
  for (int i = 0; i < first.part.count; ++i) {
    if (by_number[static_cast<std::size_t>(i)] == nullptr) missing.push_back(i + 1);
  }
  if (!missing.empty()) refuse_missing(missing, first.part.count);
  std::vector<std::string> pieces(first.run.n_pieces);
  for (const PartFile* file : by_number) {
    const std::vector<std::size_t> numbers = file->part.pieces(pieces.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) pieces[numbers[i]] = file->pieces[i];
  }
  return pieces;
}

}  // namespace eigentrail
