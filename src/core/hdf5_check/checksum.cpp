#include "core/hdf5_check/checksum.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace eigentrail::hdf5_check {
namespace {

using State = std::array<std::uint32_t, 3>;

/// One step of lookup3's mixing: x = (x - y) xor rot(y, bits); y = y + z.
void turn(std::uint32_t& x, std::uint32_t& y, std::uint32_t z, int bits) {
  x -= y;
  x ^= std::rotl(y, bits);
  y += z;
}

void mix(State& s) {
  auto& [a, b, c] = s;
  turn(a, c, b, 4);
  turn(b, a, c, 6);
  turn(c, b, a, 8);
  turn(a, c, b, 16);
  turn(b, a, c, 19);
  turn(c, b, a, 4);
}

void finish(State& s) {
  auto& [a, b, c] = s;
  const auto step = [](std::uint32_t& x, std::uint32_t y, int bits) {
    x ^= y;
    x -= std::rotl(y, bits);
  };
  step(c, b, 14);
  step(a, c, 11);
  step(b, a, 25);
  step(c, b, 16);
  step(a, c, 4);
  step(b, a, 14);
  step(c, b, 24);
}

/// Adds up to twelve bytes, as little-endian numbers of 32 bits, to the state.
void add(State& s, std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i)
    s[i / 4] += std::uint32_t{static_cast<unsigned char>(bytes[i])} << 8U * (i % 4);
}

}  // namespace

std::uint32_t checksum(std::string_view bytes) {
  State state;
  state.fill(0xdeadbeefU + static_cast<std::uint32_t>(bytes.size()));
  if (bytes.empty()) return state[2];
  for (; bytes.size() > 12; bytes.remove_prefix(12)) {
    add(state, bytes.substr(0, 12));
    mix(state);
  }
  add(state, bytes);
  finish(state);
  return state[2];
}

}  // namespace eigentrail::hdf5_check
