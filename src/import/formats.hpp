// The importers, one file each.
#pragma once

#include "eigentrail/import/importer.hpp"

namespace eigentrail {

Importer openfast_importer();
Importer elastodyn_importer();
Importer beamdyn_importer();
Importer matrix_market_importer();
Importer matlab_importer();
Importer nastran_importer();
Importer numpy_importer();

}  // namespace eigentrail
