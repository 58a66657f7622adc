// Matrices of Nastran in bulk data, as punch files have them: entries DMIG in small fields (8 columns), large
// fields (16 columns, DMIG*) or fields between commas (MSC Nastran, Quick Reference Guide, DMIG).
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "import/op4.hpp"

namespace eigentrail {

/// A displacement (components 1 to 3) or rotation (4 to 6) of a grid point, or a scalar point (0).
struct DmigFreedom {
  std::int32_t point = 0;
  std::int32_t component = 0;
  auto operator<=>(const DmigFreedom&) const = default;
};

/// "grid 12, T3", "grid 12, R1" or "point 12".
std::string name_of(const DmigFreedom& freedom);

struct DmigEntry {
  DmigFreedom row, column;
  double value = 0.0;
};

/// A matrix as those of OUTPUT4, with entries in place of its values. `digits` are the most of an entry; with
/// a fault the entries are not kept.
struct DmigMatrix : Op4Matrix {
  bool symmetric = false;  ///< entries stand for their mirror images, too
  std::vector<DmigEntry> entries = {};
};

/// The matrix with these freedoms as rows and columns, which are in ascending order and have those of all
/// entries. Throws std::invalid_argument if entries contradict each other.
Matrix dense_matrix(const DmigMatrix& matrix, const std::vector<DmigFreedom>& freedoms);

/// All matrices in a text; other bulk data are skipped. Throws InputError that names file and line.
std::vector<DmigMatrix> parse_dmig(std::string_view text, const std::string& path);

}  // namespace eigentrail
