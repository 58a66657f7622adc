// The datasets of a loci file that grow while it is written, as a list: schema 1 (docs/loci-file.md).
#pragma once

#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct GrowingDataset {
  std::string name;
  ElementType type = ElementType::real;
  std::vector<std::string> dimensions;
  std::string units;
  std::string long_name;
};

/// Those of a trace of `model`, in the order of their creation.
std::vector<GrowingDataset> growing_datasets(const Model& model, const TraceOptions& options);

/// Whether the loci file has a dataset of this name, which the traced parameter cannot have, then.
bool is_loci_dataset(const std::string& name);

}  // namespace eigentrail
