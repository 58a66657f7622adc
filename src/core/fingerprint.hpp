// A short number that tells contents apart.
#pragma once

#include <cstdint>
#include <string_view>

namespace eigentrail {

/// FNV-1a hash (Fowler, Noll, Vo): detects damage, not deliberate changes. `hash`: that of the bytes before.
inline std::uint64_t fingerprint(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace eigentrail
