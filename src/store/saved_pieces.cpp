#include "store/saved_pieces.hpp"

#include <array>
#include <cstring>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "core/fingerprint.hpp"

namespace eigentrail {
namespace {

using RecordHead = std::array<std::uint64_t, 2>;  ///< size and fingerprint of the bytes that follow

std::string record_of(const std::string& bytes) {
  const RecordHead head{bytes.size(), fingerprint(bytes)};
  return std::string(reinterpret_cast<const char*>(head.data()), sizeof head) + bytes;
}

/// Takes the first record from `left`; empty if none is whole.
std::string_view take_record(std::string_view& left) {
  RecordHead head{};
  if (left.size() < sizeof head) return {};
  std::memcpy(head.data(), left.data(), sizeof head);
  const std::string_view bytes = left.substr(sizeof head, head[0]);
  if (bytes.size() < head[0] || fingerprint(bytes) != head[1]) return {};
  left.remove_prefix(sizeof head + bytes.size());
  return bytes;
}

}  // namespace

SavedPieces saved_pieces(std::string_view bytes) {
  SavedPieces saved;
  std::string_view left = bytes.substr(std::min(bytes.size(), pieces_format.size()));
  const std::string_view first = take_record(left);
  if (first.empty()) return saved;
  std::uint64_t n_pieces = 0;
  SharedRun& run = saved.run;
  Part part;
  unpack(first, run.command, run.scene_path, run.settings, n_pieces, part.number, part.count,
         saved.blas_kernel);
  run.n_pieces = static_cast<std::size_t>(n_pieces);
  if (part.number >= 1 && part.number <= part.count) run.part = part;
  for (std::string_view piece = take_record(left); !piece.empty(); piece = take_record(left)) {
    PiecesByName::key_type name;
    std::string result;
    unpack(piece, name, result);
    saved.pieces.insert_or_assign(name, std::move(result));
  }
  saved.size = bytes.size() - left.size();
  return saved;
}

std::string begin_of_pieces(const SharedRun& run) {
  const Part part = run.part.value_or(Part{0, 0});
  return std::string(pieces_format) +
         record_of(packed(run.command, run.scene_path, run.settings, static_cast<std::uint64_t>(run.n_pieces),
                          part.number, part.count, blas_kernel()));
}

std::string record_of_piece(const std::string& kind, std::size_t number, const std::string& bytes) {
  return record_of(packed(PiecesByName::key_type(kind, number), bytes));
}

}  // namespace eigentrail
