// Files as they are before anything reads them.
#pragma once

#include <cstdint>
#include <string>

namespace eigentrail {

/// Throws InputError unless `path` is a regular file: reading a pipe or a device may wait or go on for ever.
void require_plain_file(const std::string& path);

/// The bytes of a file. Throws InputError for what is no regular file or cannot be read.
std::string bytes_of_file(const std::string& path);

/// The contents of a file of texts. Throws InputError for what is no regular file, cannot be read, has more
/// than `most_bytes`, or a byte zero.
std::string read_text(const std::string& path, std::uintmax_t most_bytes);

}  // namespace eigentrail
