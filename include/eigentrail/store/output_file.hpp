// Files that commands write: which existing files may be replaced, and atomic replacement of files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

/// Whether an existing file may be replaced by one of this format: only if it has this format itself. All
/// other files (scenes, files of matrices, damaged files) are protected.
bool may_be_replaced(const std::string& path, const std::string& format);

/// Throws InputError if no file can be created in the folder of `path`, or another process writes it just
/// now. To be called before a long computation. Leaves no file behind, also none of a run that was killed.
void check_can_create(const std::string& path);

/// What becomes of a file that is there when another one is written to its path.
enum class Existing { keep, replace };

/// What becomes of two files of which `second` refers to `first` and is renamed last: they are replaced if
/// `force`, and if a run was killed after it had renamed the first only. Throws InputError if one of them is
/// there otherwise, with `advice`. Both may be the same file.
Existing existing_pair(const std::string& first, const std::string& second, bool force,
                       const std::string& advice);

/// A file to write: its bytes are `parts`, one after the other.
struct NewFile {
  std::string path;
  std::vector<std::string_view> parts;
};

/// Writes files, each atomically: writes all of them under other names, `path`.partial, flushes them to the
/// disk, and then renames one after the other. After a crash or a power failure `path` names either the
/// complete new file or the old one. A file that is replaced keeps its permissions, and a symbolic link to it
/// stays. Throws std::system_error on failure; what was not renamed is then removed. Throws
/// std::runtime_error for a file that is there and to be kept; what should have taken its place remains as
/// `path`.partial.
void write_durably(const std::vector<NewFile>& files, Existing existing = Existing::keep);
void write_durably(const std::string& path, std::vector<std::string_view> parts,
                   Existing existing = Existing::keep);

}  // namespace eigentrail
