// Files of pieces that have been computed: the rest of an interrupted run, and a part of a run.
//
// A file is a line that names its format, and records: what the run is, then each finished piece. A record is
// its size, its fingerprint and its bytes.
#pragma once

#include "eigentrail/store/part_file.hpp"

namespace eigentrail {

struct SavedPieces {
  SharedRun run;
  std::string blas_kernel;  ///< with which they were computed
  PiecesByName pieces;
  std::size_t size = 0;  ///< of what is whole, in bytes; 0: the run is not known yet
};

/// What the bytes of a file hold as far as its records are whole. Throws ArchiveError if a whole record has
/// not the contents of one.
SavedPieces saved_pieces(std::string_view bytes);

/// What a file begins with, and what is appended for a piece.
std::string begin_of_pieces(const SharedRun& run);
std::string record_of_piece(const std::string& kind, std::size_t number, const std::string& bytes);

}  // namespace eigentrail
