// The importers, one file each.
#pragma once

#include "eigentrail/import/importer.hpp"

namespace eigentrail {}  // namespace eigentrail
