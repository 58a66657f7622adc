#include "store/loci_tables.hpp"

#include <limits>

#include <numeric>

#include "store/labelled_datasets.hpp"
#include "store/loci_schema.hpp"
#include "store/projection_datasets.hpp"
#include "store/shaft_datasets.hpp"

namespace eigentrail {
namespace {

std::vector<std::int64_t> count_from(std::uint64_t first, std::size_t n) {
  std::vector<std::int64_t> list(n);
  std::iota(list.begin(), list.end(), static_cast<std::int64_t>(first));
  return list;
}

std::vector<std::string> numbered_modes(std::size_t first, std::size_t end) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < end; ++i) names.push_back("mode " + std::to_string(i + 1));
  return names;
}

/// Creates a dimension with its labels. `growing`: it may be extended later.
template <class Label>
void create_dimension(Hdf5Writer& file, const std::string& name, ElementType type,
                      const std::vector<Label>& labels, const std::string& long_name, bool growing = false) {
  file.create_dataset({name, type, {labels.size()}, growing, {{"units", "1"}, {"long_name", long_name}}});
  if (!labels.empty()) file.write_rows(name, 0, labels);
  file.make_scale(name, name);
}

std::map<std::string, std::vector<std::pair<std::string, unsigned>>> by_dimension(
    const std::vector<GrowingDataset>& datasets) {
  std::map<std::string, std::vector<std::pair<std::string, unsigned>>> map;
  for (const GrowingDataset& dataset : datasets) {
    for (std::size_t d = 0; d < dataset.dimensions.size(); ++d)
      map[dataset.dimensions[d]].emplace_back(dataset.name, static_cast<unsigned>(d));
  }
  return map;
}

}  // namespace

LociTables::LociTables(Hdf5Writer file, const Model& model, const TraceOptions& options, int order,
                       std::size_t modes, const std::vector<std::string>& motions)
    : file_(std::move(file)),
      parameter_(options.parameter),
      trimmed_(trimmed_names(model.description())),
      has_constraints_(model.n_constraints() > 0),
      modes_(modes),
      functions_(modes) {
  create_dimensions(model.description(), order, modes);
  write_shafts(file_, model.description());
  if (const Projection* projection = model.projection()) write_projection(file_, *projection);
  if (!motions.empty()) create_dimension(file_, "motion", ElementType::text, motions, "motion of a mass");
  const auto datasets = growing_datasets(model, options);
  for (const GrowingDataset& dataset : datasets) {
    Shape shape;
    for (const std::string& dimension : dataset.dimensions) shape.push_back(file_.shape(dimension)[0]);
    std::map<std::string, std::string> attributes{{"units", dataset.units}, {"long_name", dataset.long_name}};
    // By the CF conventions this makes the parameter an auxiliary coordinate along `node`.
    if (dataset.dimensions[0] == "node" && dataset.name != parameter_) attributes["coordinates"] = parameter_;
    file_.create_dataset({dataset.name, dataset.type, shape, true, attributes});
    for (std::size_t d = 0; d < dataset.dimensions.size(); ++d)
      file_.attach_scale(dataset.name, dataset.dimensions[d], static_cast<unsigned>(d));
  }
  extensible_ = by_dimension(datasets);
}

LociTables::LociTables(Hdf5Writer file, const Model& model, const TraceOptions& options)
    : file_(std::move(file)),
      parameter_(options.parameter),
      trimmed_(trimmed_names(model.description())),
      has_constraints_(model.n_constraints() > 0),
      modes_(file_.shape("mode").at(0)),
      functions_(file_.shape("function").at(0)),
      points_(file_.shape("node").at(0)),
      steps_(file_.shape("step").at(0)),
      extensible_(by_dimension(growing_datasets(model, options))) {}

void LociTables::create_dimensions(const ModelDescription& description, int order, std::size_t modes) {
  create_dimension(file_, "node", ElementType::integer, count_from(0, 0), "path point", true);
  create_dimension(file_, "step", ElementType::integer, count_from(0, 0),
                   "step from a path point to the next", true);
  create_dimension(file_, "mode", ElementType::text, numbered_modes(0, modes), "mode", true);
  create_dimension(file_, "function", ElementType::integer, count_from(0, modes),
                   "smooth function of a mode or of a block of modes", true);
  create_dimension(file_, "end", ElementType::text, std::vector<std::string>{"left", "right"},
                   "end of a step, or of a stable range");
  create_dimension(file_, "coordinate", ElementType::text, description.coordinate_names, "coordinate");
  write_dataset(file_, {"coordinate_unit", "1", "unit of the coordinate"}, {"coordinate"},
                description.coordinate_units);
  create_dimension(file_, "order", ElementType::integer, count_from(0, static_cast<std::size_t>(order) + 1),
                   "power of the distance from the end of the step");
  if (has_constraints_)
    create_dimension(file_, "constraint", ElementType::text, description.constraint_names, "constraint");
  create_dimension(file_, "event", ElementType::integer, count_from(0, 0), "special point of the trace",
                   true);
  create_dimension(file_, "scene_parameter", ElementType::text, description.parameters.names(),
                   "parameter of the scene");
  std::vector<std::string> units;
  for (std::size_t i = 0; i < description.parameters.size(); ++i)
    units.push_back(label_unit(description.parameters[i].unit));
  write_dataset(file_, {"scene_parameter_unit", "1", "unit of the parameter"}, {"scene_parameter"}, units);
}

void LociTables::extend(const std::string& dimension, std::size_t size) {
  for (const auto& [name, axis] : extensible_[dimension]) file_.extend(name, axis, size);
}

void LociTables::grow_modes(std::size_t wanted) {
  if (wanted <= modes_) return;
  file_.write_rows("mode", modes_, numbered_modes(modes_, wanted));
  extend("mode", wanted);
  modes_ = wanted;
}

void LociTables::grow_functions(std::size_t wanted) {
  if (wanted <= functions_) return;
  file_.write_rows("function", functions_, count_from(functions_, wanted - functions_));
  extend("function", wanted);
  functions_ = wanted;
}

void LociTables::append(const LociRows& rows) {
  const std::size_t n = rows.points();
  if (n == 0) return;
  file_.write_rows("node", points_, count_from(points_, n));
  file_.write_rows(parameter_, points_, rows.parameter);
  file_.write_rows("eigenvalue", points_, rows.eigenvalue);
  file_.write_rows("eigenvalue_derivative", points_, rows.eigenvalue_derivative);
  file_.write_rows("frequency", points_, rows.frequency);
  file_.write_rows("damped_frequency", points_, rows.damped_frequency);
  file_.write_rows("damping_ratio", points_, rows.damping_ratio);
  file_.write_rows("mode_shape", points_, rows.mode_shape);
  file_.write_rows("residual", points_, rows.residual);
  file_.write_rows("condition", points_, rows.condition);
  file_.write_rows("rounding", points_, rows.rounding);
  file_.write_rows("growing_unfollowed", points_, rows.growing_unfollowed);
  if (!rows.whirl.empty()) {
    file_.write_rows("whirl", points_, rows.whirl);
    file_.write_rows("whirl_reverse", points_, rows.whirl_reverse);
  }
  file_.write_rows("equilibrium", points_, rows.equilibrium);
  if (has_constraints_) file_.write_rows("multiplier", points_, rows.multiplier);
  for (std::size_t i = 0; i < trimmed_.size(); ++i) {
    file_.write_rows(trimmed_[i], points_, rows.trimmed[i]);
    if (rows.steps() > 0) file_.write_rows(step_dataset(trimmed_[i]), steps_, rows.step_trimmed[i]);
  }
  if (rows.steps() > 0) {
    file_.write_rows("step", steps_, count_from(steps_, rows.steps()));
    file_.write_rows("step_length", steps_, rows.step_length);
    file_.write_rows("step_parameter", steps_, rows.step_parameter);
    file_.write_rows("dense_output", steps_, rows.dense_output);
    file_.write_rows("dense_block", steps_, rows.dense_block);
    file_.write_rows("dense_chart", steps_, rows.dense_chart);
    file_.write_rows("mode_block", steps_, rows.mode_block);
    file_.write_rows("certified", steps_, rows.certified);
  }
  points_ += n;
  steps_ += rows.steps();
}

}  // namespace eigentrail
