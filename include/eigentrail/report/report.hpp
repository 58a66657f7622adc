// Writes one self-contained HTML page from files of eigentrail: loci, boundaries, maps, accuracy studies.
#pragma once

#include <string>
#include <vector>

namespace eigentrail {

/// Reads the files and writes the page to `path`. The page is replaced atomically: `path` names either the
/// complete new page or what was there before. Throws InputError if a file cannot be read or contains nothing
/// to show, and std::runtime_error if the page cannot be written.
void write_report(const std::vector<std::string>& files, const std::string& path);

/// Whether a file is a page written by `write_report`.
bool is_report(const std::string& path);

}  // namespace eigentrail
