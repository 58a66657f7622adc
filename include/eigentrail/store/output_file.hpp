// Files that commands write: what may be written over, and files that appear complete or not at all.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace eigentrail {

/// Whether an existing file may be replaced by one of this format: it is one itself. A scene, a file of
/// matrices, a damaged file or anything else that somebody wrote may not.
bool may_be_replaced(const std::string& path, const std::string& format);

/// Tries whether a file can be created under that name, and leaves nothing behind. Throws InputError when
/// not: better before the work than after it.
void check_can_create(const std::string& path);

/// Writes `parts`, one after the other, under a name beside `path` that nobody else uses, and renames it: the
/// file appears complete or not at all, and an existing one is replaced in that moment. The contents reach
/// the disk first, the new name after: also without power either file is there. Throws std::system_error, and
/// leaves nothing behind then.
void write_durably(const std::string& path, std::initializer_list<std::string_view> parts);

}  // namespace eigentrail
