// What the process that reads a file is asked, and how requests and answers travel: both are archives
// (core/archive.hpp) with their length in front.
//
// A request has a name, and numbers of rows. An answer begins with a bool: false if a text follows that says
// why there is none.
#pragma once

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>

#include "core/archive.hpp"

namespace eigentrail {

// What answers are made of.
struct StoredArray;
struct NamedArray;
Members<2> archived(const StoredArray*);
Members<6> archived(const NamedArray*);

enum class ReaderRequest : std::uint8_t {
  open,        ///< a file of HDF5 by its path: true
  open_image,  ///< the bytes of one: true
  has,         ///< a path: bool
  members,     ///< of a group: std::vector<std::string>, alphabetical
  read,  ///< rows of a dataset: std::optional<StoredArray>, nothing for other objects. The shape is that of
         ///< the dataset, the elements are those of the rows that fit into 8 MB, of one row at least
  attributes,  ///< of an object: std::map<std::string, StoredArray>, those that are numbers or texts.
               ///< DIMENSION_LIST has the names of the scales
  matlab,      ///< all variables of a file of MATLAB by its path: std::vector<NamedArray>
};

/// Descriptor of the socket in the reading process.
inline constexpr int reader_socket = 0;

/// Exit codes of the reading process where memory ends: that of the machine or of the user, or what a file of
/// its size may take.
inline constexpr int reader_without_memory = 3, reader_at_limit = 4;

/// Moves all bytes with `move`, send or recv; false if the other process has gone.
template <class Byte, class Move>
bool move_bytes(Move move, int socket, Byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t moved = move(socket, data, size, MSG_NOSIGNAL);
    if (moved == 0 || (moved < 0 && errno != EINTR)) return false;
    if (moved < 0) continue;
    data += moved;
    size -= static_cast<std::size_t>(moved);
  }
  return true;
}

inline bool send_message(int socket, const std::string& message) {
  const std::uint64_t size = message.size();
  return move_bytes(send, socket, reinterpret_cast<const char*>(&size), sizeof size) &&
         move_bytes(send, socket, message.data(), message.size());
}

/// Nothing if the other process has gone. Memory grows with what arrives, not with the length that is
/// announced.
inline std::optional<std::string> receive_message(int socket) {
  constexpr std::uint64_t piece = 1U << 24U;
  std::uint64_t left = 0;
  if (!move_bytes(recv, socket, reinterpret_cast<char*>(&left), sizeof left)) return std::nullopt;
  std::string message;
  while (left > 0) {
    const auto size = static_cast<std::size_t>(std::min(left, piece));
    message.resize(message.size() + size);
    if (!move_bytes(recv, socket, message.data() + message.size() - size, size)) return std::nullopt;
    left -= size;
  }
  return message;
}

}  // namespace eigentrail
