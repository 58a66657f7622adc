// Reads the bytes of an HDF5 file; checks every length.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/hdf5_check/checksum.hpp"
#include "core/hdf5_file.hpp"

namespace eigentrail::hdf5_check {

/// HDF5's undefined address (all bits set).
inline constexpr std::uint64_t undefined = ~std::uint64_t{0};

/// Reports content that no correct program writes.
[[noreturn]] inline void damaged(std::uint64_t at, const std::string& what) {
  throw Hdf5Error("damaged at byte " + std::to_string(at) + ": " + what);
}

/// Reports content that HDF5 allows but that files of matrices or results do not need.
[[noreturn]] inline void refused(std::uint64_t at, const std::string& what) {
  throw Hdf5Error("at byte " + std::to_string(at) + ": " + what);
}

/// Reads little-endian numbers and texts from a piece of the file. Throws Hdf5Error instead of reading past
/// its end.
class Cursor {
 public:
  Cursor(std::string_view bytes, std::uint64_t offset) : bytes_(bytes), offset_(offset) {}

  std::uint64_t left() const { return bytes_.size() - at_; }
  /// Position in the file, in bytes.
  std::uint64_t offset() const { return offset_ + at_; }
  std::string_view rest() const { return bytes_.substr(at_); }

  std::uint64_t number(std::uint64_t size) {
    const std::string_view bytes = text(size);
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i > 0; --i)
      value = value << 8U | static_cast<unsigned char>(bytes[i - 1]);
    return value;
  }
  unsigned u8() { return static_cast<unsigned>(number(1)); }
  unsigned u16() { return static_cast<unsigned>(number(2)); }
  std::uint64_t u32() { return number(4); }
  std::uint64_t u64() { return number(8); }

  std::string_view text(std::uint64_t size) {
    if (size > left()) damaged(offset(), "what begins here ends too early");
    const std::string_view part = bytes_.substr(at_, size);
    at_ += size;
    return part;
  }
  void skip(std::uint64_t size) { (void)text(size); }
  Cursor part(std::uint64_t size) {
    const std::uint64_t begin = offset();
    return {text(size), begin};
  }

  /// A zero-terminated text; also skips the zero.
  std::string_view name() {
    const std::size_t length = rest().find('\0');
    if (length == std::string_view::npos) damaged(offset(), "a name without an end");
    const std::string_view result = text(length);
    skip(1);
    return result;
  }
  /// The same, with padding to a multiple of eight bytes.
  std::string_view padded_name() {
    const std::string_view result = name();
    skip((8 - (result.size() + 1) % 8) % 8);
    return result;
  }

  void expect(std::string_view signature) {
    const std::uint64_t here = offset();
    if (text(signature.size()) != signature) damaged(here, "expected '" + std::string(signature) + "'");
  }
  void expect_version(unsigned version) {
    const std::uint64_t here = offset();
    if (u8() != version) damaged(here, "unknown version");
  }

 private:
  std::string_view bytes_;
  std::uint64_t offset_;
  std::size_t at_ = 0;
};

/// A piece of the file; throws Hdf5Error unless it lies inside the file.
inline Cursor piece(std::string_view file, std::uint64_t at, std::uint64_t size) {
  if (at > file.size() || size > file.size() - at) damaged(at, "lies outside of the file");
  return {file.substr(at, size), at};
}

/// Throws Hdf5Error unless the four bytes after a piece are its checksum.
inline void expect_checksum(std::string_view file, std::uint64_t at, std::uint64_t size) {
  (void)piece(file, at, size);
  if (piece(file, at + size, 4).u32() != checksum(file.substr(at, size))) damaged(at, "wrong checksum");
}

}  // namespace eigentrail::hdf5_check
