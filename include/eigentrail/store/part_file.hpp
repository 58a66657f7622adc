// Parts of a run that is shared among machines: each part computes some of the pieces of the run and writes
// them to a file; the files of all parts together give what the whole run gives, bit for bit.
//
// A part is a file of saved pieces, as an interrupted run leaves it (unfinished_run.hpp), that has all pieces
// of the part.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eigentrail/core/workers.hpp"
#include "eigentrail/scene/scene.hpp"
#include "eigentrail/store/output_file.hpp"

namespace eigentrail {

/// What a file of saved pieces begins with.
inline constexpr std::string_view pieces_format = "eigentrail-pieces 1\n";

/// What a result depends on, as labels and texts.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// What is computed in pieces.
struct SharedRun {
  std::string command;     ///< "map", "boundary", "sweep" or "accuracy"
  std::string scene_path;  ///< as the user gave it; may differ
  /// Version, scene, contents of its files, options. The command goes on from these when the parts are
  /// joined.
  Settings settings;
  std::size_t n_pieces = 0;
  std::optional<Part> part = {};  ///< of which the pieces are computed; none: all are

  /// The settings, the command and the part.
  Settings all_settings() const;

  /// Numbers of the pieces that are computed.
  std::vector<std::size_t> pieces() const { return part.value_or(Part{}).pieces(n_pieces); }

  /// The text of a setting; empty if there is none of this label.
  std::optional<std::string> setting(const std::string& label) const;
};

/// Results by kind and number.
using PiecesByName = std::map<std::pair<std::string, std::uint64_t>, std::string>;

struct PartFile {
  std::string path;  ///< of the file
  SharedRun run;
  std::string blas_kernel;  ///< with which the pieces were computed
  PiecesByName pieces;
};

/// The settings that every run has: version of the program, scene, and the contents of the files that the
/// scene names.
Settings settings_of(const Scene& scene);

/// Throws InputError if the file is missing, no part, damaged, or written by another version.
PartFile read_part_file(const std::string& path);

/// The pieces of the whole run. Throws InputError if the parts are not those of one run, one is missing or
/// one is there twice.
PiecesByName joined(const std::vector<PartFile>& parts);

}  // namespace eigentrail
