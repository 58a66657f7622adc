// MATLAB's files of variables (.mat, versions 4, 5, 7 and 7.3), read with libmatio.
#pragma once

#include <functional>
#include <vector>

#include "import/named_array.hpp"

namespace eigentrail::reader {

/// All variables of a file. `opened` is called once the file is open. Throws std::runtime_error with a
/// message for the user.
std::vector<NamedArray> read_matlab(const char* path, const std::function<void()>& opened);

}  // namespace eigentrail::reader
