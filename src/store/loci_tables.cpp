#include "store/loci_tables.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "eigentrail/model/projection.hpp"
#include "store/labelled_datasets.hpp"

namespace eigentrail {
namespace {

std::vector<std::string> numbered_modes(std::size_t first, std::size_t end) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < end; ++i) names.push_back("mode " + std::to_string(i + 1));
  return names;
}

void create_trace_dimensions(Hdf5Writer& file, const Model& model, int order, std::size_t modes) {
  const ModelDescription& description = model.description();
  const auto create = [&file](const char* name, const char* long_name, const auto& labels,
                              bool growing = false) {
    write_dimension(file, {name, "1", long_name}, labels, growing);
  };
  create("node", "path point", counted(0), true);
  create("step", "step from a path point to the next", counted(0), true);
  create("mode", "mode", numbered_modes(0, modes), true);
  create("function", "smooth function of a mode or of a block of modes", counted(modes), true);
  create("end", "end of a step, or of a stable range", std::vector<std::string>{"left", "right"});
  create("coordinate", "coordinate", description.coordinate_names);
  write_dataset(file, {"coordinate_unit", "1", "unit of the coordinate"}, {"coordinate"},
                description.coordinate_units);
  create("order", "power of the distance from the end of the step",
         counted(static_cast<std::size_t>(order) + 1));
  if (model.n_constraints() > 0) create("constraint", "constraint", description.constraint_names);
  create("event", "special point of the trace", counted(0), true);
  create("scene_parameter", "parameter of the scene", description.parameters.names());
  std::vector<std::string> units;
  for (std::size_t i = 0; i < description.parameters.size(); ++i)
    units.push_back(label_unit(description.parameters[i].unit));
  write_dataset(file, {"scene_parameter_unit", "1", "unit of the parameter"}, {"scene_parameter"}, units);
}

/// What elements are that have not been set, in memory as in the file.
template <class Element>
Element not_set() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if constexpr (std::is_same_v<Element, double>) return nan;
  if constexpr (std::is_same_v<Element, Complex>) return {nan, nan};
  if constexpr (std::is_same_v<Element, std::int64_t>) return -1;
  return {};
}

/// Names, places and coordinates of the nodes of shafts; nothing for a model without.
void write_shafts(Hdf5Writer& file, const ModelDescription& description) {
  if (description.shafts.empty()) return;
  std::vector<std::string> names;
  std::vector<std::int64_t> numbers, coordinates;
  std::vector<double> places;
  std::int64_t number = 0;
  for (const SpinningShaft& shaft : description.shafts) {
    for (std::size_t i = 0; i < shaft.nodes.size(); ++i) {
      names.push_back((shaft.name.empty() ? "" : shaft.name + " ") + "node " + std::to_string(i + 1));
      numbers.push_back(number);
      places.push_back(shaft.places[i]);
      for (const Eigen::Index coordinate : shaft.nodes[i]) coordinates.push_back(coordinate);
    }
    ++number;
  }
  write_dimension(file, {"shaft_node", "1", "node of a shaft"}, names);
  write_dimension(file, {"shaft_axis", "1", "direction of a displacement"},
                  std::vector<std::string>{"x", "y"});
  write_whole(file, whole_dataset("shaft_number"), numbers);
  write_whole(file, whole_dataset("shaft_place"), places);
  write_whole(file, whole_dataset("shaft_coordinate"), coordinates);
}

/// The dimension `freedom`, the basis over it, and what is known of the projection as attributes.
void write_projection(Hdf5Writer& file, const Projection& projection) {
  if (projection.is_of_family()) {
    write_dimension(file, {"freedom", "1", "freedom of the large model"}, projection.names);
    write_whole(file, whole_dataset("projection_basis"), row_major(projection.basis));
  }
  write_dimension(file, {"projection_place", "1", "values of the parameter whose modes span the space"},
                  projection.sampled_at);
  file.set_attribute("projection_error", projection.error);
  file.set_attribute("projection_error_at", projection.error_at);
  file.set_attribute("count_sparse_factorizations", projection.factorizations);
  file.set_attribute("count_sparse_solutions", projection.solutions);
}

}  // namespace

void create_dimensions(Hdf5Writer& file, const Model& model, int order, std::size_t modes,
                       const std::vector<std::string>& motions) {
  create_trace_dimensions(file, model, order, modes);
  write_shafts(file, model.description());
  if (const Projection* projection = model.projection()) write_projection(file, *projection);
  if (!motions.empty()) write_dimension(file, {"motion", "1", "motion of a mass"}, motions);
}

LociTables::LociTables(Hdf5Writer file, const Model& model, const TraceOptions& options)
    : file_(std::move(file)) {
  for (const LociDataset& dataset : growing_datasets(model, options)) {
    for (const std::string& dimension : dataset.dimensions) sizes_[dimension] = file_.shape(dimension)[0];
    columns_.push_back({dataset, no_elements(dataset.type)});
  }
}

LociTables::Column& LociTables::column_called(const std::string& dataset) {
  return *std::ranges::find(columns_, dataset,
                            [](const Column& one) -> const std::string& { return one.dataset.name; });
}

std::size_t LociTables::width(const Column& column) const {
  const std::vector<std::string>& dimensions = column.dataset.dimensions;
  std::size_t product = 1;
  for (std::size_t d = 1; d < dimensions.size(); ++d) product *= sizes_.at(dimensions[d]);
  return product;
}

/// `added`: labels of the new elements of the dimension.
template <class Label>
void LociTables::grow(const std::string& dimension, const std::vector<Label>& added) {
  write_rows();  // they have the old width
  std::size_t& size = sizes_.at(dimension);
  file_.write_rows(dimension, size, added);
  size += added.size();
  for (const Column& column : columns_) {
    const std::vector<std::string>& dimensions = column.dataset.dimensions;
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      if (dimensions[d] == dimension) file_.extend(column.dataset.name, static_cast<unsigned>(d), size);
    }
  }
}

void LociTables::grow_modes(std::size_t wanted) {
  if (wanted > modes()) grow("mode", numbered_modes(modes(), wanted));
}

void LociTables::grow_functions(std::size_t wanted) {
  const std::size_t functions = sizes_.at("function");
  if (wanted > functions) grow("function", counted(wanted - functions, functions));
}

void LociTables::begin_row(const std::string& dimension) {
  ++begun_.at(dimension);
  for (Column& column : columns_) {
    if (column.dataset.dimensions[0] != dimension) continue;
    const auto lengthen = [&](auto& rows) {
      using Element = typename std::decay_t<decltype(rows)>::value_type;
      rows.resize(rows.size() + width(column), not_set<Element>());
    };
    std::visit(lengthen, column.rows);
  }
}

void LociTables::create_columns(std::optional<std::size_t> events) {
  const std::string& parameter = columns_.front().dataset.name;
  if (file_.has(parameter)) return;
  if (events) file_.write_rows("event", 0, counted(*events));
  for (const auto& [dataset, rows] : columns_) {
    const std::string& along = dataset.dimensions[0];
    std::map<std::string, std::string> attributes;
    // By the CF conventions this makes the parameter an auxiliary coordinate along `node`.
    if (along == "node" && dataset.name != parameter) attributes["coordinates"] = parameter;
    const bool grows = !events || file_.shape(along)[0] == 0;  // netCDF knows no other empty dimensions
    create_dataset(file_, dataset, dataset.type, dataset.dimensions, grows, std::move(attributes));
  }
}

void LociTables::write_rows(std::optional<std::size_t> events) {
  const Hdf5Turn turn;
  for (const auto& [dimension, begun] : begun_) {
    const std::size_t written = sizes_.at(dimension);
    file_.write_rows(dimension, written, counted(begun, written));
  }
  create_columns(events);
  for (Column& column : columns_) {
    const std::string& along = column.dataset.dimensions[0];
    if (!begun_.contains(along)) continue;
    const auto write = [&](auto& rows) {
      file_.write_rows(column.dataset.name, sizes_.at(along), rows);
      rows.clear();
    };
    std::visit(write, column.rows);
  }
  for (auto& [dimension, begun] : begun_) sizes_.at(dimension) += std::exchange(begun, 0);
}

}  // namespace eigentrail
