// List of the datasets of a loci file: schema 1 (docs/loci-file.md).
#pragma once

#include <string>
#include <vector>

#include "core/hdf5_types.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "store/labelled_datasets.hpp"

namespace eigentrail {

struct LociDataset : DatasetLabel {
  ElementType type = ElementType::real;
  std::vector<std::string> dimensions;
};

/// The datasets that grow during a trace of `model`, in the order of their creation.
std::vector<LociDataset> growing_datasets(const Model& model, const TraceOptions& options);

/// Name of the dataset with the series of a trimmed parameter.
inline std::string step_dataset(const std::string& parameter) {
  return "step_" + parameter;
}

/// Names of the trimmed parameters.
std::vector<std::string> trimmed_names(const ModelDescription& description);

/// Whether a loci file has a dataset of this name. The traced parameter cannot have such a name, because its
/// values are a dataset named after it.
bool is_loci_dataset(const std::string& name);

/// A dataset that is written as a whole. `parameter_unit`: of the traced parameter.
LociDataset whole_dataset(const std::string& name, const std::string& parameter_unit = "1");

/// Writes such a dataset; its dimensions must exist.
template <class Element>
void write_whole(Hdf5Writer& file, const LociDataset& dataset, const std::vector<Element>& data) {
  write_dataset(file, dataset, dataset.dimensions, data);
}

/// The datasets along the dimension `range`.
std::vector<LociDataset> datasets_of_ranges();

/// The growing datasets along the dimension `event`, itself included.
std::vector<std::string> datasets_of_events();

}  // namespace eigentrail
