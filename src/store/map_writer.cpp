#include "eigentrail/store/map_writer.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/hdf5_writer.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

const std::array<std::string, 11> map_names = {"unstable",       "margin",    "damping_ratio", "line_status",
                                               "line_reached",   "line_work", "axis_point",    "axis_line",
                                               "axis_parameter", "axis_kind", "axis_frequency"};

/// Writes the file. Its two dimensions have the names of the two parameters.
class MapFile {
 public:
  MapFile(const MapSetup& setup, const StabilityMap& map)
      : file_(Hdf5Writer::in_memory("stability map")),
        setup_(setup),
        map_(map),
        first_(setup.trace.scene.parameters.at(setup.trace.options.parameter)),
        second_(setup.trace.scene.parameters.at(setup.options.second)) {}

  /// The bytes of the whole file.
  std::string write() {
    write_attributes();
    write_cells();
    write_lines();
    write_axis_points();
    return file_.image();
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
  std::vector<double> seconds, margin, damping_ratio;
  std::vector<std::int64_t> unstable;
  for (const MapLine& line : map_.lines) {
    seconds.push_back(line.second);
    unstable.insert(unstable.end(), line.unstable.begin(), line.unstable.end());
    margin.insert(margin.end(), line.margin.begin(), line.margin.end());
    damping_ratio.insert(damping_ratio.end(), line.damping_ratio.begin(), line.damping_ratio.end());
  }
  write_dimension(file_, {second_.name, label_unit(second_.unit), "second parameter " + second_.name},
                  seconds);
  write_dimension(file_, {first_.name, label_unit(first_.unit), "first parameter " + first_.name},
                  map_.first);
  const std::vector<std::string> both{second_.name, first_.name};
  write_dataset(file_, {"unstable", "1", "number of modes that grow; -1: unknown"}, both, unstable);
  write_dataset(file_, {"margin", "1/s", "-max Re s of the followed modes"}, both, margin);
  write_dataset(file_, {"damping_ratio", "1", "least -Re s/abs(s) of the complex pairs"}, both,
                damping_ratio);
}

void MapFile::write_lines() {
  std::vector<std::string> status;
  std::vector<double> reached;
  std::vector<std::int64_t> work;
  for (const MapLine& line : map_.lines) {
    status.push_back(line.status == TraceStatus::completed ? "completed" : line.message);
    reached.push_back(line.reached);
    work.push_back(static_cast<std::int64_t>(line.factorizations()));
  }
  const std::vector<std::string> along{second_.name};
  write_dataset(file_, {"line_status", "1", "completed, or why the trace of the line ended early"}, along,
                status);
  write_dataset(file_,
                {"line_reached", label_unit(first_.unit), "last value of " + first_.name + " of the trace"},
                along, reached);
  write_dataset(file_, {"line_work", "1", "complex LU factorizations"}, along, work);
}

void MapFile::write_axis_points() {
  std::vector<std::int64_t> lines;
  std::vector<double> parameters, frequencies;
  std::vector<std::string> kinds;
  for (std::size_t i = 0; i < map_.lines.size(); ++i) {
    for (const AxisPoint& point : map_.lines[i].axis_points) {
      lines.push_back(static_cast<std::int64_t>(i));
      parameters.push_back(point.p);
      kinds.push_back(point.kind);
      frequencies.push_back(point.frequency);
    }
  }
  std::vector<std::int64_t> numbers(lines.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  write_dimension(file_, {"axis_point", "1", "place on a line where an eigenvalue meets the imaginary axis"},
                  numbers);
  const std::vector<std::string> along{"axis_point"};
  write_dataset(file_, {"axis_line", "1", "line, counted from 0 along " + second_.name}, along, lines);
  write_dataset(file_, {"axis_parameter", label_unit(first_.unit), "value of " + first_.name}, along,
                parameters);
  write_dataset(file_, {"axis_kind", "1", "what happens there"}, along, kinds);
  write_dataset(file_, {"axis_frequency", "rad/s", "Im s there"}, along, frequencies);
}

}  // namespace

void check_map_names(const MapSetup& setup) {
  const Scene& scene = setup.trace.scene;
  for (const std::string& name : {setup.trace.options.parameter, setup.options.second}) {
    if (std::find(map_names.begin(), map_names.end(), name) == map_names.end()) continue;
    throw scene_error(scene, scene.parameters.at(name).where,
                      "[parameters] " + name + ": a parameter of the map cannot be called '" + name +
                          "', the file has a dataset of that name; rename it");
  }
}

std::string map_file(const MapSetup& setup, const StabilityMap& map) {
  return MapFile(setup, map).write();
}

}  // namespace eigentrail
