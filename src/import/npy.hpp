// NumPy's format of one array (NEP 1, versions 1.0 to 3.0 of the format).
#pragma once

#include <string>
#include <string_view>

#include "import/named_arrays.hpp"

namespace eigentrail {

/// The array in the bytes of a .npy file: numbers (f4, f8, signed and unsigned integers, booleans) of either
/// byte order, or texts (U, S). Throws InputError that begins with `where`.
NamedArray read_npy(std::string_view bytes, const std::string& where);

/// The bytes that such a file has according to its header, from the first bytes of it. Throws like read_npy.
std::size_t announced_npy_bytes(std::string_view beginning, const std::string& where);

}  // namespace eigentrail
