#include "eigentrail/store/map_writer.hpp"

#include "core/hdf5_writer.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

/// Writes the file. Its two dimensions have the names of the two parameters.
class MapFile {
 public:
  MapFile(const MapSetup& setup, const StabilityMap& map, const Parameter& first, const Parameter& second)
      : file_(Hdf5Writer::in_memory("stability map")),
        setup_(setup),
        map_(map),
        first_(first),
        second_(second) {}

  /// The whole file.
  Hdf5Writer& write() {
    write_attributes();
    write_cells();
    write_lines();
    write_axis_points();
    return file_;
  }

 private:
  void write_attributes();
  void write_counts();
  void write_cells();
  void write_lines();
  void write_axis_points();

  Hdf5Writer file_;
  const MapSetup& setup_;
  const StabilityMap& map_;
  const Parameter& first_;
  const Parameter& second_;
};

void MapFile::write_attributes() {
  write_provenance(file_, map_format, map_schema_version, setup_.trace.scene, setup_.trace.options);
  file_.set_attribute("second_parameter", second_.name);
  write_notes(file_, notes_on(map_, setup_.options.second));
  write_counts();
}

void MapFile::write_counts() {
  const auto count = [this](const char* name, std::uint64_t value) {
    file_.set_attribute(std::string("count_") + name, static_cast<std::int64_t>(value));
  };
  const MapTotals totals = total(map_);
  count("lines", map_.lines.size());
  count("cells", totals.cells);
  count("stable_cells", totals.stable);
  count("marginal_cells", totals.marginal);
  count("unstable_cells", totals.unstable);
  count("unknown_cells", totals.unknown);
  count("factorizations", totals.factorizations);
  count("spectra", totals.spectra);
}

void MapFile::write_cells() {
  const std::vector<MapLine>& lines = map_.lines;
  std::vector<double> seconds;
  for (const MapLine& line : lines) seconds.push_back(line.second);
  write_dimension(file_, {second_.name, label_unit(second_.unit), "second parameter " + second_.name},
                  seconds);
  write_dimension(file_, {first_.name, label_unit(first_.unit), "first parameter " + first_.name},
                  map_.first);
  const std::vector<std::string> both{second_.name, first_.name};
  write_column(file_, {"unstable", "1", "number of modes that grow; -1: unknown"}, both, lines,
               &MapLine::unstable);
  write_column(file_, {"margin", "1/s", "-max Re s of the followed modes"}, both, lines, &MapLine::margin);
  write_column(file_, {"damping_ratio", "1", "least -Re s/abs(s) of the complex pairs"}, both, lines,
               &MapLine::damping_ratio);
}

void MapFile::write_lines() {
  const std::vector<std::string> along{second_.name};
  write_column(file_, {"line_status", "1", "completed, or why the trace of the line ended early"}, along,
               map_.lines, [](const MapLine& line) {
                 return line.status == TraceStatus::completed ? std::string("completed") : line.message;
               });
  write_column(file_,
               {"line_reached", label_unit(first_.unit), "last value of " + first_.name + " of the trace"},
               along, map_.lines, &MapLine::reached);
  write_column(file_, {"line_work", "1", "complex LU factorizations"}, along, map_.lines,
               &MapLine::factorizations);
}

void MapFile::write_axis_points() {
  std::vector<std::int64_t> lines;
  std::vector<AxisPoint> points;
  for (std::size_t i = 0; i < map_.lines.size(); ++i) {
    const std::vector<AxisPoint>& of_line = map_.lines[i].axis_points;
    lines.insert(lines.end(), of_line.size(), static_cast<std::int64_t>(i));
    points.insert(points.end(), of_line.begin(), of_line.end());
  }
  write_dimension(file_, {"axis_point", "1", "place on a line where an eigenvalue meets the imaginary axis"},
                  counted(lines.size()));
  const std::vector<std::string> along{"axis_point"};
  write_dataset(file_, {"axis_line", "1", "line, counted from 0 along " + second_.name}, along, lines);
  write_column(file_, {"axis_parameter", label_unit(first_.unit), "value of " + first_.name}, along, points,
               &AxisPoint::p);
  write_column(file_, {"axis_kind", "1", "what happens there"}, along, points, &AxisPoint::kind);
  write_column(file_, {"axis_frequency", "rad/s", "Im s there"}, along, points, &AxisPoint::frequency);
}

}  // namespace

void check_map_names(const MapSetup& setup) {
  const StabilityMap none;
  Parameter first, second;
  first.name = "first parameter";
  second.name = "second parameter";
  MapFile file(setup, none, first, second);
  require_other_names(setup.trace.scene, {setup.trace.options.parameter, setup.options.second}, file.write(),
                      "map", "the file");
}

std::string map_file(const MapSetup& setup, const StabilityMap& map) {
  const Parameters& parameters = setup.trace.scene.parameters;
  return MapFile(setup, map, parameters.at(setup.trace.options.parameter),
                 parameters.at(setup.options.second))
      .write()
      .image();
}

}  // namespace eigentrail
