// The elements of MATLAB's files of version 5 (MathWorks, MAT-File Format), checked before libmatio reads
// them.
#pragma once

#include <string>

namespace eigentrail::reader {

/// libmatio reads a file that is cut short as if it had fewer variables, and fills a variable that has fewer
/// numbers than its dimensions say up with zeros. Throws std::runtime_error for both. Files of other versions
/// pass.
void check_mat_elements(const std::string& path);

}  // namespace eigentrail::reader
