// Bytes as bulk data of Nastran, and the matrices in them.
#include <algorithm>
#include <stdexcept>

#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/dmig.hpp"

EIGENTRAIL_FUZZ(dmig) {
  try {
    for (const eigentrail::DmigMatrix& matrix : eigentrail::parse_dmig(bytes, "a.pch")) {
      std::vector<eigentrail::DmigFreedom> freedoms;
      for (const eigentrail::DmigEntry& entry : matrix.entries) {
        freedoms.push_back(entry.row);
        freedoms.push_back(entry.column);
      }
      std::sort(freedoms.begin(), freedoms.end());
      freedoms.erase(std::unique(freedoms.begin(), freedoms.end()), freedoms.end());
      if (freedoms.size() < 1000) (void)eigentrail::dense_matrix(matrix, freedoms);
    }
  } catch (const eigentrail::InputError&) {
  } catch (const std::invalid_argument&) {
  }
}
