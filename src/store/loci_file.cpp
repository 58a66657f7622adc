#include "eigentrail/store/loci_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/hdf5_file.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "store/labelled_datasets.hpp"
#include "store/loci_schema.hpp"
#include "store/path_datasets.hpp"
#include "store/provenance.hpp"
#include "store/whole_datasets.hpp"

namespace eigentrail {
namespace {

/// Whether a point is a branch point, at which a trace may take another path: each path knows it only to half
/// of the digits.
bool is_branch_point(const LociFile& loci, std::size_t node) {
  return std::any_of(loci.events.begin(), loci.events.end(), [&](const LociEvent& event) {
    return event.kind == "branch_point" && event.node == static_cast<int>(node);
  });
}

void check_ends(const LociFile& loci, std::size_t step) {
  constexpr double rounding = 1e-12;
  constexpr double half_of_digits = 1e-8;
  const double size = loci.highest() - loci.lowest() + std::abs(loci.highest());
  const PathStep& here = loci.steps[step];
  for (const std::size_t end : {0, 1}) {
    const double expected = here.parameter(static_cast<Eigen::Index>(end), 0);
    const double p = loci.p[step + end];
    const double allowed = is_branch_point(loci, step + end) ? half_of_digits : rounding;
    if (std::abs(expected - p) <= allowed * size) continue;
    throw InputError(loci.path + ": point " + std::to_string(step + end + 1) + " has " + loci.parameter +
                     " = " + exact_text(p) + ", the step " + (end == 0 ? "behind" : "before") +
                     " it step_parameter = " + exact_text(expected));
  }
  if (follows_parameter(here) && !((loci.p[step + 1] - loci.p[step]) * here.length > 0.0))
    throw InputError(loci.path + ": " + loci.parameter + " goes from " + exact_text(loci.p[step]) + " to " +
                     exact_text(loci.p[step + 1]) + " on a step whose step_length is " +
                     exact_text(here.length));
}

/// Whether each mode exists on a step.
std::vector<bool> modes_on(const LociFile& loci, std::size_t step) {
  std::vector<bool> exist(loci.modes.size(), false);
  for (const DenseBlock& block : loci.steps[step].blocks) {
    for (const int mode : block.modes) exist[static_cast<std::size_t>(mode)] = true;
  }
  return exist;
}

/// At an end of the trace, the side without a step does not count.
void check_existence(const LociFile& loci) {
  std::vector<bool> before(loci.modes.size(), true);
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    const std::vector<bool> behind =
        node < loci.steps.size() ? modes_on(loci, node) : std::vector<bool>(loci.modes.size(), true);
    for (std::size_t mode = 0; mode < loci.modes.size(); ++mode) {
      const Complex s = loci.eigenvalues(static_cast<Eigen::Index>(node), static_cast<Eigen::Index>(mode));
      if (!before[mode] || !behind[mode] || (!std::isnan(s.real()) && !std::isnan(s.imag()))) continue;
      throw InputError(loci.path + ": eigenvalue of " + loci.modes[mode] + " at " + loci.parameter + " = " +
                       exact_text(loci.p[node]) + " is nan, where the mode exists beside it");
    }
    before = behind;
  }
}

/// Checks points and steps against each other: steps begin and end at the points and go on along the
/// parameter, and a mode that exists on both sides of a point has an eigenvalue there. Throws InputError with
/// the place.
void check_points_and_steps(const LociFile& loci) {
  for (std::size_t step = 0; step < loci.steps.size(); ++step) check_ends(loci, step);
  if (!loci.steps.empty()) check_existence(loci);
}

void check_format(const Hdf5File& file, const std::string& path) {
  const std::string format = file.has_attribute("format") ? file.text_attribute("format") : "";
  if (format.starts_with("eigentrail-") && format != loci_format) {
    throw InputError(path + ": holds '" + format + "', not loci; open it in h5py or xarray");
  }
  if (format != loci_format) throw InputError(path + ": is an HDF5 file, but no loci file of eigentrail");
  check_schema(file, path, loci_schema_version);
}

using RowMajorReal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void require(bool fits, const LociFile& loci, const std::string& dataset) {
  require_fit(fits, loci.path, dataset);
}

/// What the points have besides their places and eigenvalues, if the file has it.
void read_points(const Hdf5File& file, LociFile& loci) {
  if (file.has("rounding")) {
    loci.rounding = read_matrix(file, "rounding", loci.p.size(), loci.modes.size());
  }
  if (file.has("growing_unfollowed")) {
    for (const std::int64_t number : file.read_integers("growing_unfollowed"))
      loci.growing_unfollowed.push_back(static_cast<int>(number));
    require(loci.growing_unfollowed.size() == loci.p.size(), loci, "growing_unfollowed");
  }
}

void read_events(const Hdf5File& file, LociFile& loci) {
  const std::vector<std::string> lines = file.read_texts("events");
  const std::size_t count = lines.size();
  const auto column = [&](const char* name, auto read) {
    auto values = (file.*read)(name);
    require(values.size() == count, loci, "events");
    return values;
  };
  const auto parameters = column("event_parameter", &Hdf5File::read_real);
  const auto half_widths = column("event_half_width", &Hdf5File::read_real);
  const auto eigenvalues = column("event_eigenvalue", &Hdf5File::read_complex);
  const auto puiseux = column("event_puiseux", &Hdf5File::read_complex);
  const auto directions = column("event_direction", &Hdf5File::read_integers);
  const auto values = column("event_value", &Hdf5File::read_real);
  const auto nodes = column("event_node", &Hdf5File::read_integers);
  loci.scene_parameters = file.read_texts("scene_parameter");
  const std::size_t n = loci.scene_parameters.size();
  const ComplexMatrix shapes = read_matrix<Complex>(file, "event_shape", count, loci.coordinates.size());
  const ComplexMatrix sensitivities = read_matrix<Complex>(file, "event_sensitivity", count, n);
  const Matrix shifts = read_matrix(file, "event_shift", count, n);
  for (const std::int64_t direction : directions)
    require(direction >= -1 && direction <= 1, loci, "event_direction");
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t kind = lines[i].find(',');
    const std::size_t modes = lines[i].rfind(',');
    require(kind != std::string::npos && modes > kind, loci, "events");
    require(nodes[i] >= 0 && nodes[i] < static_cast<std::int64_t>(loci.n_nodes()), loci, "event_node");
    const auto row = static_cast<Eigen::Index>(i);
    const EventFacts facts{half_widths[i], puiseux[i], static_cast<int>(directions[i]), values[i]};
    loci.events.push_back({facts, lines[i].substr(0, kind), parameters[i], eigenvalues[i],
                           lines[i].substr(modes + 1), static_cast<int>(nodes[i]), shapes.row(row),
                           sensitivities.row(row), shifts.row(row)});
  }
}

/// The trimmed parameters, which a root attribute names, and their series on the steps.
void read_trimmed(const Hdf5File& file, LociFile& loci) {
  const auto names = loci.attributes.find("trimmed");
  if (names == loci.attributes.end()) return;
  const std::size_t orders = file.shape("dense_output").at(3);
  for (const std::string& name : split(names->second, ',')) {
    TrimmedParameter& trimmed = loci.trimmed.emplace_back();
    trimmed = {name, file.text_attribute(name, "units"), file.text_attribute(name, "long_name"),
               file.read_real(name)};
    require(trimmed.values.size() == loci.n_nodes(), loci, name);
    require_finite(trimmed.values, loci.path, name);
    const std::string series = step_dataset(name);
    require(file.shape(series) == Shape{loci.steps.size(), 2, orders}, loci, series);
    const std::vector<double> data = file.read_real(series);
    require_finite(data, loci.path, series);
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
  const auto value = parsed_number<double>(text);
  if (!value)
    throw InputError(path + ": attribute " + name + ": expected a number, found '" + printable(text) + "'");
  return *value;
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
  for (std::size_t step = 0; step < steps.size(); ++step) {
    const DenseBlock* block = block_of(step, static_cast<int>(mode));
    if (block == nullptr) continue;
    const double length = std::abs(steps[step].length);
    covered += length;
    if (block->certified) certified += length;
  }
  return covered > 0.0 ? certified / covered : NAN;
}

std::vector<std::pair<std::size_t, std::size_t>> LociFile::uncertified(std::size_t mode) const {
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    const DenseBlock* block = block_of(step, static_cast<int>(mode));
    if (block == nullptr || block->certified) continue;
    if (stretches.empty() || stretches.back().second != step) stretches.emplace_back(step, step);
    stretches.back().second = step + 1;
  }
  return stretches;
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
  static_cast<RecordedPath&>(loci) = read_path(file, loci.parameter, loci.modes.size(), path);
  read_points(file, loci);
  read_events(file, loci);
  check_points_and_steps(loci);
  loci.ranges = read_stable_ranges(file, loci.modes.size());
  loci.data_errors = read_data_errors(file, loci.steps.size(), loci.modes.size(), loci.events.size());
  loci.equilibrium = read_matrix(file, "equilibrium", loci.n_nodes(), loci.coordinates.size());
  loci.multiplier.resize(static_cast<Eigen::Index>(loci.n_nodes()), 0);
  if (!loci.constraints.empty())
    loci.multiplier = read_matrix(file, "multiplier", loci.n_nodes(), loci.constraints.size());
  read_trimmed(file, loci);
  loci.residual = file.read_real("residual");
  loci.condition = file.read_real("condition");
  const std::size_t expected = loci.n_nodes() * loci.modes.size();
  if (loci.residual.size() != expected || loci.condition.size() != expected)
    throw InputError(path + ": residual and condition do not fit the other datasets");
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
    require(shapes.size() == loci.modes.size() * loci.coordinates.size(), loci, "mode_shape");
    use(node, shapes);
  }
}

}  // namespace eigentrail
