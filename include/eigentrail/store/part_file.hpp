// Parts of a run that is shared among machines: each part computes some of the pieces of the run and writes
// them to a file; the files of all parts together give what the whole run gives, bit for bit.
//
// A part is an HDF5 file (format "eigentrail-part") whose attributes say what it is. Behind the HDF5 data,
// where its readers do not look, are the pieces, and a mark with a checksum of the whole file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eigentrail/core/workers.hpp"
#include "eigentrail/scene/scene.hpp"
#include "eigentrail/store/output_file.hpp"

namespace eigentrail {

inline constexpr const char* part_format = "eigentrail-part";
inline constexpr int part_schema_version = 1;

/// What a result depends on, as labels and texts.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// What is the same in all parts of a run.
struct SharedRun {
  std::string command;     ///< "map", "boundary", "sweep" or "accuracy"
  std::string scene_path;  ///< as the user gave it; may differ
  /// Version, scene, contents of its files, options. The command goes on from these when the parts are
  /// joined.
  Settings settings;
  std::size_t n_pieces = 0;

  /// The settings and the command.
  Settings all_settings() const;

  /// The text of a setting; empty if there is none of this label.
  std::optional<std::string> setting(const std::string& label) const;
};

struct PartFile {
  std::string path;  ///< of the file
  SharedRun run;
  Part part;
  std::vector<std::string> pieces;  ///< results, in the order of Part::pieces
  std::string blas_kernel = {};     ///< with which they were computed; write_part sets it
};

/// The settings that every run has: version of the program, scene, and the contents of the files that the
/// scene names.
Settings settings_of(const Scene& scene);

/// Writes the file as write_durably does.
void write_part(const PartFile& file, Existing existing);

/// Throws InputError if the file is missing, no part, damaged, or written by another version.
PartFile read_part_file(const std::string& path);

/// The pieces of the whole run, in order. Throws InputError if the parts are not those of one run, one is
/// missing or one is there twice.
std::vector<std::string> joined(const std::vector<PartFile>& parts);

}  // namespace eigentrail
