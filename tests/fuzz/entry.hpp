// What is tried with damaged bytes, by name: a fuzzer has one of them, a program that replays corpora all
// that it is built from.
#pragma once

#include <map>
#include <string_view>

namespace eigentrail::fuzz {

using Trial = void (*)(std::string_view bytes);

/// Those of this program.
inline std::map<std::string_view, Trial>& trials() {
  static std::map<std::string_view, Trial> all;
  return all;
}

struct Registered {
  Registered(std::string_view name, Trial trial) { trials()[name] = trial; }
};

}  // namespace eigentrail::fuzz

/// Begins the function of a trial; its argument is `bytes`.
#define EIGENTRAIL_FUZZ(name)                                                     \
  static void try_##name(std::string_view bytes);                                 \
  static const eigentrail::fuzz::Registered registered_##name(#name, try_##name); \
  static void try_##name(std::string_view bytes)
