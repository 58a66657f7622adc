// Files that commands write: what may be written over, and files that appear complete or not at all.
#pragma once

#include <functional>
#include <string>

namespace eigentrail {

/// Whether an existing file may be replaced by one of this format: it is one itself. A scene, a file of
/// matrices, a damaged file or anything else that somebody wrote may not.
bool may_be_replaced(const std::string& path, const std::string& format);

/// Tries whether a file can be created under that name, and leaves nothing behind. Throws InputError when
/// not: better before the work than after it.
void check_can_create(const std::string& path);

/// Calls `write` with a name beside `path` that nobody else uses and renames what it wrote: the file appears
/// complete or not at all, and an existing one is replaced in that moment. Exceptions of `write` pass, and
/// std::filesystem::filesystem_error when the file cannot be renamed; nothing is left behind.
void write_complete(const std::string& path, const std::function<void(const std::string& partial)>& write);

}  // namespace eigentrail
