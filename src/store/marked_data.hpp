// Bytes behind the HDF5 data of a file, where its readers do not look: the state of an unfinished trace, and
// a mark with its size and a checksum of the whole file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "eigentrail/core/errors.hpp"

namespace eigentrail {

/// The data with their mark, to be appended to the HDF5 data `image`.
std::string marked_data(std::string_view image, std::string data);

/// The two parts of a file; they refer to its bytes.
struct MarkedFile {
  std::string_view image, data;
};

/// Takes a file apart; empty if it has no mark. Throws `damaged` if the mark does not fit the rest.
std::optional<MarkedFile> take_apart(std::string_view bytes, const InputError& damaged);

}  // namespace eigentrail
