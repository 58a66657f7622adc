#include "eigentrail/store/map_writer.hpp"

#include "core/hdf5_writer.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

void write_counts(Hdf5Writer& file, const StabilityMap& map) {
  const MapTotals totals = total(map);
  file.set_attribute("count_lines", map.lines.size());
  file.set_attribute("count_cells", totals.cells);
  file.set_attribute("count_stable_cells", totals.stable);
  file.set_attribute("count_marginal_cells", totals.marginal);
  file.set_attribute("count_unstable_cells", totals.unstable);
  file.set_attribute("count_unknown_cells", totals.unknown);
  file.set_attribute("count_factorizations", totals.factorizations);
  file.set_attribute("count_spectra", totals.spectra);
}

/// The two dimensions have the names of the two parameters.
void write_cells(Hdf5Writer& file, const StabilityMap& map, const Parameter& first, const Parameter& second) {
  const std::vector<MapLine>& lines = map.lines;
  std::vector<double> seconds;
  for (const MapLine& line : lines) seconds.push_back(line.second);
  write_dimension(file, {second.name, label_unit(second.unit), "second parameter " + second.name}, seconds);
  write_dimension(file, {first.name, label_unit(first.unit), "first parameter " + first.name}, map.first);
  const std::vector<std::string> both{second.name, first.name};
  write_column(file, {"unstable", "1", "number of modes that grow; -1: unknown"}, both, lines,
               &MapLine::unstable);
  write_column(file, {"margin", "1/s", "-max Re s of the followed modes"}, both, lines, &MapLine::margin);
  write_column(file, {"damping_ratio", "1", "least -Re s/abs(s) of the complex pairs"}, both, lines,
               &MapLine::damping_ratio);
}

void write_lines(Hdf5Writer& file, const StabilityMap& map, const Parameter& first, const Parameter& second) {
  const std::vector<std::string> along{second.name};
  write_column(file, {"line_status", "1", "completed, or why the trace of the line ended early"}, along,
               map.lines, [](const MapLine& line) {
                 return line.status == TraceStatus::completed ? std::string("completed") : line.message;
               });
  write_column(file,
               {"line_reached", label_unit(first.unit), "last value of " + first.name + " of the trace"},
               along, map.lines, &MapLine::reached);
  write_column(file, {"line_work", "1", "complex LU factorizations"}, along, map.lines,
               &MapLine::factorizations);
}

void write_axis_points(Hdf5Writer& file, const StabilityMap& map, const Parameter& first,
                       const Parameter& second) {
  std::vector<std::int64_t> lines;
  std::vector<AxisPoint> points;
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    const std::vector<AxisPoint>& of_line = map.lines[i].axis_points;
    lines.insert(lines.end(), of_line.size(), static_cast<std::int64_t>(i));
    points.insert(points.end(), of_line.begin(), of_line.end());
  }
  write_dimension(file, {"axis_point", "1", "place on a line where an eigenvalue meets the imaginary axis"},
                  counted(lines.size()));
  const std::vector<std::string> along{"axis_point"};
  write_dataset(file, {"axis_line", "1", "line, counted from 0 along " + second.name}, along, lines);
  write_column(file, {"axis_parameter", label_unit(first.unit), "value of " + first.name}, along, points,
               &AxisPoint::p);
  write_column(file, {"axis_kind", "1", "what happens there"}, along, points, &AxisPoint::kind);
  write_column(file, {"axis_frequency", "rad/s", "Im s there"}, along, points, &AxisPoint::frequency);
}

Hdf5Writer map_writer(const MapSetup& setup, const StabilityMap& map, const Parameter& first,
                      const Parameter& second) {
  Hdf5Writer file = Hdf5Writer::in_memory("stability map");
  write_provenance(file, map_format, map_schema_version, setup.trace.scene, setup.trace.options);
  file.set_attribute("second_parameter", second.name);
  write_notes(file, notes_on(map, setup.options.second));
  write_counts(file, map);
  write_cells(file, map, first, second);
  write_lines(file, map, first, second);
  write_axis_points(file, map, first, second);
  return file;
}

}  // namespace

void check_map_names(const MapSetup& setup) {
  const auto [first, second] = parameters_of_other_names();
  require_other_names(setup.trace.scene, {setup.trace.options.parameter, setup.options.second},
                      map_writer(setup, {}, first, second), "map", "the file");
}

std::string map_file(const MapSetup& setup, const StabilityMap& map) {
  const Parameters& parameters = setup.trace.scene.parameters;
  return map_writer(setup, map, parameters.at(setup.trace.options.parameter),
                    parameters.at(setup.options.second))
      .image();
}

}  // namespace eigentrail
