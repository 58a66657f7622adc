#include "store/marked_data.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/fingerprint.hpp"

namespace eigentrail {
namespace {

constexpr std::string_view state_mark = "eigentrail-state";

/// The last bytes of the file.
struct Mark {
  std::array<char, state_mark.size()> kind = {};
  std::uint64_t size = 0;      ///< of the data, which precede the mark, in bytes
  std::uint64_t checksum = 0;  ///< of all bytes before the mark
};

}  // namespace

std::string marked_data(std::string_view image, std::string data) {
  Mark mark{{}, data.size(), fingerprint(data, fingerprint(image))};
  std::copy(state_mark.begin(), state_mark.end(), mark.kind.begin());
  return std::move(data.append(reinterpret_cast<const char*>(&mark), sizeof mark));
}

std::optional<MarkedFile> take_apart(std::string_view bytes, const InputError& damaged) {
  Mark mark;
  if (bytes.size() < sizeof mark) return std::nullopt;
  std::memcpy(&mark, bytes.data() + bytes.size() - sizeof mark, sizeof mark);
  if (std::string_view(mark.kind.data(), mark.kind.size()) != state_mark) return std::nullopt;
  bytes.remove_suffix(sizeof mark);
  if (mark.size > bytes.size() || fingerprint(bytes) != mark.checksum) throw damaged;
  const std::size_t end = bytes.size() - mark.size;
  return MarkedFile{bytes.substr(0, end), bytes.substr(end)};
}

}  // namespace eigentrail
