// Files that commands write: which existing files may be replaced, and atomic replacement of files.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace eigentrail {

/// Whether an existing file may be replaced by one of this format: only if it has this format itself. All
/// other files (scenes, files of matrices, damaged files) are protected.
bool may_be_replaced(const std::string& path, const std::string& format);

/// Throws InputError if no file can be created in the folder of `path`. To be called before a long
/// computation. Leaves no file behind.
void check_can_create(const std::string& path);

/// Replaces the file atomically by `parts`, one after the other: writes them to a temporary file in the same
/// folder, flushes it to the disk, and renames it to `path`. After a crash or a power failure `path` names
/// either the complete new file or the old one. Throws std::system_error on failure; the temporary file is
/// then removed.
void write_durably(const std::string& path, std::initializer_list<std::string_view> parts);

}  // namespace eigentrail
