// What the process that reads a file is asked, and how requests and answers travel: both are archives
// (core/archive.hpp) with their length in front.
//
// Request and arguments                                       answer
// open                                                        bool: true
// has, path                                                   bool
// members, group                                              std::vector<std::string>, alphabetical
// layout, dataset                                             std::optional<DatasetLayout>: nothing for other
// objects read, dataset, ElementType, first row, number of rows       StoredElements of that type attributes,
// object                                          std::map<std::string, StoredArray> dimensions, dataset
// std::vector<std::string>: names of its scales matlab std::vector<NamedArray>: all variables
//
// An answer begins with a bool: false if a text follows that says why there is none.
#pragma once

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>

namespace eigentrail {

enum class ReaderRequest : std::uint8_t { open, has, members, layout, read, attributes, dimensions, matlab };

/// Descriptors of the reading process: its end of the socket, and the file.
inline constexpr int reader_socket = 0;
inline constexpr int reader_file = 3;

/// Sends all bytes; false if the other process has gone.
inline bool send_bytes(int socket, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = send(socket, data, size, MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) return false;
    if (sent < 0) continue;
    data += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

inline bool send_message(int socket, const std::string& message) {
  const std::uint64_t size = message.size();
  return send_bytes(socket, reinterpret_cast<const char*>(&size), sizeof size) &&
         send_bytes(socket, message.data(), message.size());
}

/// Receives `size` bytes; false if the other process has gone before.
inline bool receive_bytes(int socket, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t received = recv(socket, data, size, 0);
    if (received == 0 || (received < 0 && errno != EINTR)) return false;
    if (received < 0) continue;
    data += received;
    size -= static_cast<std::size_t>(received);
  }
  return true;
}

/// Receives a message; nothing if the other process has gone. Memory grows with what arrives, not with the
/// length that is announced.
inline std::optional<std::string> receive_message(int socket) {
  constexpr std::uint64_t piece = 1U << 24U;
  std::uint64_t left = 0;
  if (!receive_bytes(socket, reinterpret_cast<char*>(&left), sizeof left)) return std::nullopt;
  std::string message;
  while (left > 0) {
    const auto size = static_cast<std::size_t>(std::min(left, piece));
    message.resize(message.size() + size);
    if (!receive_bytes(socket, message.data() + message.size() - size, size)) return std::nullopt;
    left -= size;
  }
  return message;
}

}  // namespace eigentrail
