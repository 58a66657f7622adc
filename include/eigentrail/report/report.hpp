// One self-contained HTML page from files of eigentrail: loci, boundaries, maps, accuracy studies.
#pragma once

#include <string>
#include <vector>

namespace eigentrail {

/// Reads the files and writes the page; it appears under its name complete or not at all, and an existing one
/// is replaced in that moment. Throws InputError for files that cannot be read or hold nothing to show, and
/// std::runtime_error when the page cannot be written.
void write_report(const std::vector<std::string>& files, const std::string& path);

/// Whether a file is a page that `write_report` wrote.
bool is_report(const std::string& path);

}  // namespace eigentrail
