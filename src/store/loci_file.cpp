#include "eigentrail/store/loci_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "store/data_error_datasets.hpp"
#include "store/loci_checks.hpp"
#include "store/loci_schema.hpp"
#include "store/range_datasets.hpp"

namespace eigentrail {
namespace {

void check_format(const Hdf5File& file, const std::string& path) {
  const std::string format = file.has_attribute("format") ? file.text_attribute("format") : "";
  if (format.starts_with("eigentrail-") && format != loci_format) {
    throw InputError(path + ": holds '" + format + "', not loci; open it in h5py or xarray");
  }
  if (format != loci_format) throw InputError(path + ": is an HDF5 file, but no loci file of eigentrail");
  const std::int64_t schema = file.integer_attribute("schema_version");
  if (schema != loci_schema_version) {
    throw InputError(path + ": has schema " + std::to_string(schema) + ", this program reads schema " +
                     std::to_string(loci_schema_version));
  }
}

using RowMajorComplex = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorReal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void require(bool holds, const LociFile& loci, const std::string& dataset) {
  if (!holds) throw InputError(loci.path + ": " + dataset + " does not fit the other datasets");
}

void require_finite(const std::vector<double>& values, const LociFile& loci, const std::string& dataset) {
  const auto bad = std::find_if_not(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (bad == values.end()) return;
  throw InputError(loci.path + ": " + dataset + " holds " + exact_text(*bad) + " as its number " +
                   std::to_string(bad - values.begin() + 1) + " where a finite number is needed");
}

void read_points(const Hdf5File& file, LociFile& loci) {
  loci.p = file.read_real(loci.parameter);
  require(file.shape(loci.parameter).size() == 1, loci, loci.parameter);
  require_finite(loci.p, loci, loci.parameter);
  require(file.shape("eigenvalue") == Shape{loci.p.size(), loci.modes.size()}, loci, "eigenvalue");
  const std::vector<Complex> data = file.read_complex("eigenvalue");
  loci.eigenvalues = Eigen::Map<const RowMajorComplex>(data.data(), static_cast<Eigen::Index>(loci.p.size()),
                                                       static_cast<Eigen::Index>(loci.modes.size()));
  if (file.has("rounding")) {
    require(file.shape("rounding") == Shape{loci.p.size(), loci.modes.size()}, loci, "rounding");
    loci.rounding = Eigen::Map<const RowMajorReal>(file.read_real("rounding").data(), loci.eigenvalues.rows(),
                                                   loci.eigenvalues.cols());
  }
  if (file.has("growing_unfollowed")) {
    for (const std::int64_t number : file.read_integers("growing_unfollowed"))
      loci.growing_unfollowed.push_back(static_cast<int>(number));
    require(loci.growing_unfollowed.size() == loci.p.size(), loci, "growing_unfollowed");
  }
}

/// The datasets of the dense output as flat row-major arrays.
struct DenseArrays {
  Shape shape;  ///< step, function, end, order
  std::vector<double> length, parameter;
  std::vector<Complex> output;
  std::vector<std::int64_t> block, chart, mode_block, certified;
};

DenseArrays read_arrays(const Hdf5File& file, const LociFile& loci) {
  DenseArrays arrays;
  arrays.shape = file.shape("dense_output");
  const Shape& shape = arrays.shape;
  const bool fits = shape.size() == 4 && shape[0] + 1 == std::max<std::uint64_t>(loci.p.size(), 1) &&
                    shape[2] == 2 && shape[3] >= 2 && shape[3] <= static_cast<std::uint64_t>(max_order);
  require(fits, loci, "dense_output");
  require(file.shape("step_length") == Shape{shape[0]}, loci, "step_length");
  require(file.shape("step_parameter") == Shape{shape[0], 2, shape[3]}, loci, "step_parameter");
  for (const char* name : {"dense_block", "dense_chart"}) {
    require(file.shape(name) == Shape{shape[0], shape[1]}, loci, name);
  }
  for (const char* name : {"mode_block", "certified"}) {
    require(file.shape(name) == Shape{shape[0], loci.modes.size()}, loci, name);
  }
  arrays.length = file.read_real("step_length");
  arrays.parameter = file.read_real("step_parameter");
  require_finite(arrays.length, loci, "step_length");
  double whole = 0.0;
  for (const double length : arrays.length) whole += std::abs(length);
  require(std::isfinite(whole), loci, "step_length");
  require_finite(arrays.parameter, loci, "step_parameter");
  arrays.output = file.read_complex("dense_output");
  arrays.block = file.read_integers("dense_block");
  arrays.chart = file.read_integers("dense_chart");
  arrays.mode_block = file.read_integers("mode_block");
  arrays.certified = file.read_integers("certified");
  return arrays;
}

/// Modes of every block of a step; the index is that of the first function of the block.
std::vector<std::vector<int>> modes_of_blocks(const DenseArrays& arrays, const LociFile& loci,
                                              std::size_t step) {
  const std::size_t n_modes = loci.modes.size();
  std::vector<std::vector<int>> modes(arrays.shape[1]);
  for (std::size_t mode = 0; mode < n_modes; ++mode) {
    const std::int64_t block = arrays.mode_block[step * n_modes + mode];
    require(block >= -1 && block < static_cast<std::int64_t>(modes.size()), loci, "mode_block");
    if (block >= 0) modes[static_cast<std::size_t>(block)].push_back(static_cast<int>(mode));
  }
  return modes;
}

/// The block of a step whose first function is `first`.
DenseBlock read_block(const DenseArrays& arrays, const LociFile& loci, std::size_t step, std::size_t first,
                      std::vector<int> modes) {
  const std::size_t functions = arrays.shape[1];
  const std::size_t orders = arrays.shape[3];
  const auto number = static_cast<std::int64_t>(first);
  std::size_t size = 0;
  while (first + size < functions && arrays.block[step * functions + first + size] == number) ++size;
  // One, two, or the k^2 entries of a matrix.
  const auto members = static_cast<std::size_t>(block_size(static_cast<Eigen::Index>(size)));
  require(modes.size() <= members && (size <= 2 || members * members == size), loci, "dense_block");
  DenseBlock block;
  block.chart = arrays.chart[step * functions + first] == 1 ? Chart::reciprocal : Chart::finite;
  block.left.resize(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(orders));
  block.right = block.left;
  for (std::size_t i = 0; i < size; ++i) {
    const Complex* row = arrays.output.data() + (step * functions + first + i) * 2 * orders;
    const auto at = static_cast<Eigen::Index>(i);
    for (std::size_t k = 0; k < orders; ++k) {
      block.left(at, static_cast<Eigen::Index>(k)) = row[k];
      block.right(at, static_cast<Eigen::Index>(k)) = row[orders + k];
    }
  }
  block.certified = std::all_of(modes.begin(), modes.end(), [&](int mode) {
    return arrays.certified[step * loci.modes.size() + static_cast<std::size_t>(mode)] == 1;
  });
  block.modes = std::move(modes);
  require(block.left.allFinite() && block.right.allFinite(), loci, "dense_output");
  return block;
}

void read_steps(const Hdf5File& file, LociFile& loci) {
  const DenseArrays arrays = read_arrays(file, loci);
  const std::size_t functions = arrays.shape[1];
  const std::size_t orders = arrays.shape[3];
  for (std::size_t step = 0; step < arrays.shape[0]; ++step) {
    PathStep path_step;
    path_step.length = arrays.length[step];
    path_step.parameter = Eigen::Map<const RowMajorReal>(arrays.parameter.data() + step * 2 * orders, 2,
                                                         static_cast<Eigen::Index>(orders));
    std::vector<std::vector<int>> modes = modes_of_blocks(arrays, loci, step);
    for (std::size_t i = 0; i < functions; ++i) {
      const bool begins = arrays.block[step * functions + i] == static_cast<std::int64_t>(i);
      require(begins || modes[i].empty(), loci, "mode_block");
      if (begins) path_step.blocks.push_back(read_block(arrays, loci, step, i, std::move(modes[i])));
    }
    loci.steps.push_back(std::move(path_step));
  }
}

template <class Item>
std::vector<Item> read_event_rows(const Hdf5File& file, const std::string& name, const LociFile& loci,
                                  std::size_t rows, std::size_t columns) {
  require(file.shape(name) == Shape{rows, columns}, loci, name);
  if (rows * columns == 0) return {};
  if constexpr (std::is_same_v<Item, double>) {
    return file.read_real(name);
  } else {
    return file.read_complex(name);
  }
}

void read_events(const Hdf5File& file, LociFile& loci) {
  const std::vector<std::string> lines = file.read_texts("events");
  const std::vector<double> parameters = file.read_real("event_parameter");
  const std::vector<double> half_widths = file.read_real("event_half_width");
  const std::vector<Complex> eigenvalues = file.read_complex("event_eigenvalue");
  const std::vector<Complex> puiseux = file.read_complex("event_puiseux");
  const std::size_t count = lines.size();
  require(parameters.size() == count && half_widths.size() == count && eigenvalues.size() == count &&
              puiseux.size() == count,
          loci, "events");
  loci.scene_parameters = file.read_texts("scene_parameter");
  const std::vector<std::int64_t> directions = file.read_integers("event_direction");
  const std::vector<double> values = file.read_real("event_value");
  const std::vector<std::int64_t> nodes = file.read_integers("event_node");
  const std::size_t coordinates = loci.coordinates.size();
  const std::vector<Complex> shapes = read_event_rows<Complex>(file, "event_shape", loci, count, coordinates);
  const std::size_t n = loci.scene_parameters.size();
  const auto sensitivities = read_event_rows<Complex>(file, "event_sensitivity", loci, count, n);
  const auto shifts = read_event_rows<double>(file, "event_shift", loci, count, n);
  require(directions.size() == count && values.size() == count && nodes.size() == count, loci, "events");
  for (const std::int64_t direction : directions)
    require(direction >= -1 && direction <= 1, loci, "event_direction");
  const auto row = [](const auto& all, std::size_t i, std::size_t size) {
    using Item = typename std::decay_t<decltype(all)>::value_type;
    return Eigen::Matrix<Item, Eigen::Dynamic, 1>::Map(all.data() + i * size,
                                                       static_cast<Eigen::Index>(size));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t kind = lines[i].find(',');
    const std::size_t modes = lines[i].rfind(',');
    require(kind != std::string::npos && modes > kind, loci, "events");
    require(nodes[i] >= 0 && nodes[i] < static_cast<std::int64_t>(loci.n_nodes()), loci, "event_node");
    loci.events.push_back({lines[i].substr(0, kind), parameters[i], eigenvalues[i],
                           lines[i].substr(modes + 1), half_widths[i], puiseux[i],
                           static_cast<int>(directions[i]), values[i], static_cast<int>(nodes[i]),
                           row(shapes, i, coordinates), row(sensitivities, i, n), row(shifts, i, n)});
  }
}

/// A dataset with one row per node and this number of columns, which may be zero.
Matrix read_rows(const Hdf5File& file, const std::string& name, const LociFile& loci, std::size_t columns) {
  if (columns == 0) return Matrix(static_cast<Eigen::Index>(loci.n_nodes()), 0);
  const Shape shape = file.shape(name);
  if (shape.size() != 2 || shape[0] != loci.n_nodes() || shape[1] != columns) {
    throw InputError(loci.path + ": " + name + " does not fit the other datasets");
  }
  const std::vector<double> data = file.read_real(name);
  return Eigen::Map<const RowMajorReal>(data.data(), static_cast<Eigen::Index>(shape[0]),
                                        static_cast<Eigen::Index>(shape[1]));
}

/// The trimmed parameters, which a root attribute names, and their series on the steps.
void read_trimmed(const Hdf5File& file, LociFile& loci) {
  const auto names = loci.attributes.find("trimmed");
  if (names == loci.attributes.end()) return;
  const std::size_t orders = file.shape("dense_output").at(3);
  std::istringstream list(names->second);
  for (std::string name; std::getline(list, name, ',');) {
    TrimmedParameter& trimmed = loci.trimmed.emplace_back();
    trimmed = {name, file.text_attribute(name, "units"), file.text_attribute(name, "long_name"),
               file.read_real(name)};
    require(trimmed.values.size() == loci.n_nodes(), loci, name);
    require_finite(trimmed.values, loci, name);
    const std::string series = step_dataset(name);
    require(file.shape(series) == Shape{loci.steps.size(), 2, orders}, loci, series);
    const std::vector<double> data = file.read_real(series);
    require_finite(data, loci, series);
    for (std::size_t step = 0; step < loci.steps.size(); ++step)
      loci.steps[step].trimmed.emplace_back(Eigen::Map<const RowMajorReal>(
          data.data() + step * 2 * orders, 2, static_cast<Eigen::Index>(orders)));
  }
}

}  // namespace

const std::string& LociFile::attribute(const std::string& name) const {
  const auto found = attributes.find(name);
  if (found == attributes.end()) throw InputError(path + ": has no attribute " + name);
  return found->second;
}

double LociFile::number(const std::string& name) const {
  const std::string& text = attribute(name);
  double value = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size())
    throw InputError(path + ": attribute " + name + ": expected a number, found '" + printable(text) + "'");
  return value;
}

std::size_t LociFile::nearest_node(double value) const {
  const auto closer = [value](double a, double b) { return std::abs(a - value) < std::abs(b - value); };
  return static_cast<std::size_t>(std::min_element(p.begin(), p.end(), closer) - p.begin());
}

std::vector<ComplexVector> LociFile::eigenvalues_at(double value) const {
  if (p.empty()) throw InputError(path + ": holds no points");
  const auto node = std::find(p.begin(), p.end(), value);
  std::vector<ComplexVector> result;
  for (const Position& position : positions(value)) result.push_back(eigenvalues_at(position));
  if (result.empty() && node != p.end()) result.emplace_back(eigenvalues.row(node - p.begin()).transpose());
  if (result.empty()) {
    throw InputError(path + ": " + parameter + " = " + exact_text(value) + " lies outside the traced range " +
                     exact_text(lowest()) + " ... " + exact_text(highest()));
  }
  return result;
}

double LociFile::certified_share(std::size_t mode) const {
  double covered = 0.0;
  double certified = 0.0;
  for (const PathStep& step : steps) {
    for (const DenseBlock& block : step.blocks) {
      if (std::find(block.modes.begin(), block.modes.end(), static_cast<int>(mode)) == block.modes.end())
        continue;
      const double length = std::abs(step.length);
      covered += length;
      if (block.certified) certified += length;
    }
  }
  return covered > 0.0 ? certified / covered : NAN;
}

void require_result_file(const std::string& path) {
  if (path.ends_with(".toml"))
    throw InputError(path + ": is a scene, no result; trace it first: eigentrail trace " + path + " -o " +
                     std::filesystem::path(path).filename().replace_extension(".h5").string());
}

namespace {

LociFile loci_in(const Hdf5File& file, const std::string& path) {
  check_format(file, path);
  LociFile loci;
  loci.path = path;
  loci.attributes = file.attribute_texts();
  loci.parameter = file.text_attribute("parameter");
  loci.parameter_unit = file.text_attribute(loci.parameter, "units");
  loci.modes = file.read_texts("mode");
  loci.coordinates = file.read_texts("coordinate");
  if (file.has("constraint")) loci.constraints = file.read_texts("constraint");
  loci.mode_names.resize(loci.modes.size());
  if (file.has("mode_name")) {
    loci.mode_names = file.read_texts("mode_name");
    require(loci.mode_names.size() == loci.modes.size(), loci, "mode_name");
  }
  read_points(file, loci);
  read_steps(file, loci);
  read_events(file, loci);
  check_points_and_steps(loci);
  loci.ranges = read_stable_ranges(file, loci.modes.size());
  loci.data_errors = read_data_errors(file, loci.steps.size(), loci.modes.size(), loci.events.size());
  loci.equilibrium = read_rows(file, "equilibrium", loci, loci.coordinates.size());
  loci.multiplier = read_rows(file, "multiplier", loci, loci.constraints.size());
  read_trimmed(file, loci);
  loci.residual = file.read_real("residual");
  loci.condition = file.read_real("condition");
  const std::size_t expected = loci.n_nodes() * loci.modes.size();
  if (loci.residual.size() != expected || loci.condition.size() != expected) {
    throw InputError(path + ": residual and condition do not fit the other datasets");
  }
  return loci;
}

}  // namespace

LociFile read_loci(const std::string& path) {
  require_result_file(path);
  return loci_in(Hdf5File::open(path), path);
}

LociFile read_loci_image(const std::string& name, std::string_view image) {
  return loci_in(Hdf5File::from_image(name, image), name);
}

void read_mode_shapes(const LociFile& loci,
                      const std::function<void(std::size_t node, std::span<const Complex> shapes)>& use) {
  const Hdf5File file = Hdf5File::open(loci.path);
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    const std::vector<Complex> shapes = file.read_complex_row("mode_shape", node);
    if (shapes.size() != loci.modes.size() * loci.coordinates.size())
      throw InputError(loci.path + ": mode_shape does not fit the other datasets");
    use(node, shapes);
  }
}

}  // namespace eigentrail
