// List of the datasets of a loci file that grow during a trace: schema 1 (docs/loci-file.md).
#pragma once

#include <string>
#include <vector>

#include "core/hdf5_types.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct GrowingDataset {
  std::string name;
  ElementType type = ElementType::real;
  std::vector<std::string> dimensions;
  std::string units;
  std::string long_name;
};

/// The growing datasets of a trace of `model`, in the order of their creation.
std::vector<GrowingDataset> growing_datasets(const Model& model, const TraceOptions& options);

/// Name of the dataset with the series of a trimmed parameter.
inline std::string step_dataset(const std::string& parameter) {
  return "step_" + parameter;
}

/// Names of the trimmed parameters, separated by commas: the root attribute "trimmed".
std::string trimmed_list(const ModelDescription& description);
std::vector<std::string> trimmed_names(const ModelDescription& description);

/// Whether a loci file has a dataset of this name. The traced parameter cannot have such a name, because its
/// values are a dataset named after it. Stable ranges: see is_range_dataset.
bool is_loci_dataset(const std::string& name);

/// The datasets along the dimension `event`, itself included.
std::vector<std::string> datasets_of_events();

}  // namespace eigentrail
