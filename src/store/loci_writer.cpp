#include "eigentrail/store/loci_writer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "core/hdf5_file.hpp"
#include "eigentrail/modes/normalization.hpp"
#include "eigentrail/store/output_file.hpp"
#include "store/labelled_datasets.hpp"
#include "store/loci_summary.hpp"
#include "store/provenance.hpp"
#include "store/range_datasets.hpp"

namespace eigentrail {
namespace {

constexpr auto flush_interval = std::chrono::seconds(1);
constexpr std::size_t flush_nodes = 256;

const std::array<std::string, 38> reserved = {"node",
                                              "step",
                                              "mode",
                                              "function",
                                              "end",
                                              "coordinate",
                                              "constraint",
                                              "order",
                                              "event",
                                              "eigenvalue",
                                              "eigenvalue_derivative",
                                              "frequency",
                                              "damping_ratio",
                                              "mode_shape",
                                              "residual",
                                              "condition",
                                              "equilibrium",
                                              "multiplier",
                                              "step_length",
                                              "step_parameter",
                                              "dense_output",
                                              "dense_block",
                                              "dense_chart",
                                              "mode_block",
                                              "certified",
                                              "events",
                                              "event_parameter",
                                              "event_eigenvalue",
                                              "event_half_width",
                                              "event_puiseux",
                                              "event_node",
                                              "event_direction",
                                              "event_value",
                                              "event_shape",
                                              "event_sensitivity",
                                              "event_shift",
                                              "scene_parameter",
                                              "scene_parameter_unit"};

std::vector<std::int64_t> count_from(std::uint64_t first, std::size_t n) {
  std::vector<std::int64_t> list(n);
  std::iota(list.begin(), list.end(), static_cast<std::int64_t>(first));
  return list;
}

/// Rows of the datasets that wait to be written, row-major.
struct Buffer {
  std::vector<double> parameter, frequency, damping_ratio, residual, condition, equilibrium, multiplier;
  std::vector<Complex> eigenvalue, eigenvalue_derivative, mode_shape;
  std::vector<double> step_length, step_parameter;
  std::vector<Complex> dense_output;
  std::vector<std::int64_t> dense_block, dense_chart, mode_block, certified;

  std::size_t points() const { return parameter.size(); }
  std::size_t steps() const { return step_length.size(); }
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> mode_names(std::size_t first, std::size_t end) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < end; ++i) names.push_back("mode " + std::to_string(i + 1));
  return names;
}

}  // namespace

void check_parameter_name(const Scene& scene, const std::string& parameter) {
  if (std::find(reserved.begin(), reserved.end(), parameter) == reserved.end() &&
      !is_range_dataset(parameter))
    return;
  SourceLocation where;
  for (const Table* trace : tables(scene, "trace")) {
    if (const Value* key = trace->find("parameter")) where = key->where;
  }
  throw scene_error(scene, where,
                    "[trace] parameter: the traced parameter cannot be called '" + parameter +
                        "', the loci file has a dataset of that name; rename it");
}

struct LociWriter::Implementation {
  Hdf5File file;
  std::string parameter;
  bool has_constraints = false;
  std::size_t n_modes = 0;      ///< columns of the file
  std::size_t n_functions = 0;  ///< rows of dense output per step
  std::size_t n_coordinates = 0;
  Buffer buffer = {};
  std::uint64_t points = 0, steps = 0;  ///< written so far
  std::chrono::steady_clock::time_point last_flush = std::chrono::steady_clock::now();
  std::vector<ComplexVector> last_shapes = {};

  /// Growing datasets by the dimension along which they may have to be extended.
  std::map<std::string, std::vector<std::pair<std::string, unsigned>>> extensible = {};

  void create_growing(const std::string& name, ElementType type, const std::vector<std::string>& dimensions,
                      const std::string& units, const std::string& long_name) {
    Shape shape{0};
    for (std::size_t d = 1; d < dimensions.size(); ++d) shape.push_back(file.shape(dimensions[d])[0]);
    std::map<std::string, std::string> attributes{{"units", units}, {"long_name", long_name}};
    // CF: the auxiliary coordinate along `node`.
    if (dimensions[0] == "node" && name != parameter) attributes["coordinates"] = parameter;
    file.create_dataset({name, type, shape, true, attributes});
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      file.attach_scale(name, dimensions[d], static_cast<unsigned>(d));
      extensible[dimensions[d]].emplace_back(name, static_cast<unsigned>(d));
    }
  }

  /// A dimension with its labels, which may grow.
  template <class Label>
  void create_dimension(const std::string& name, ElementType type, const std::vector<Label>& labels,
                        const std::string& long_name, bool growing = false) {
    file.create_dataset({name, type, {labels.size()}, growing, {{"units", "1"}, {"long_name", long_name}}});
    if (!labels.empty()) file.write_rows(name, 0, labels);
    file.make_scale(name, name);
  }

  void create_dimensions(const ModelDescription& description, int order) {
    create_dimension("node", ElementType::integer, count_from(0, 0), "path point", true);
    create_dimension("step", ElementType::integer, count_from(0, 0), "step from a path point to the next",
                     true);
    create_dimension("mode", ElementType::text, mode_names(0, n_modes), "mode", true);
    create_dimension("function", ElementType::integer, count_from(0, n_functions),
                     "smooth function of a mode or of a block of modes", true);
    create_dimension("end", ElementType::text, std::vector<std::string>{"left", "right"},
                     "end of a step, or of a stable range");
    create_dimension("coordinate", ElementType::text, description.coordinate_names, "coordinate");
    create_dimension("order", ElementType::integer, count_from(0, static_cast<std::size_t>(order) + 1),
                     "power of the distance from the end of the step");
    if (has_constraints)
      create_dimension("constraint", ElementType::text, description.constraint_names, "constraint");
    create_dimension("event", ElementType::integer, count_from(0, 0), "special point of the trace", true);
    create_dimension("scene_parameter", ElementType::text, description.parameters.names(),
                     "parameter of the scene");
    std::vector<std::string> units;
    for (std::size_t i = 0; i < description.parameters.size(); ++i)
      units.push_back(label_unit(description.parameters[i].unit));
    write_dataset(file, {"scene_parameter_unit", "1", "unit of the parameter"}, {"scene_parameter"}, units);
  }

  void create_datasets(const Model& model, const TraceOptions& options, int order) {
    const ModelDescription& description = model.description();
    const Parameter& traced = description.parameters.at(options.parameter);
    const std::string unit = label_unit(traced.unit);
    has_constraints = model.n_constraints() > 0;
    n_coordinates = description.coordinate_names.size();
    create_dimensions(description, order);
    const std::string per_unit = unit == "1" ? "1/s" : "1/s/(" + unit + ")";
    create_growing(parameter, ElementType::real, {"node"}, unit, "traced parameter " + parameter);
    create_growing("eigenvalue", ElementType::complex, {"node", "mode"}, "1/s", "eigenvalue s");
    create_growing("eigenvalue_derivative", ElementType::complex, {"node", "mode"}, per_unit,
                   "ds/d" + parameter);
    create_growing("frequency", ElementType::real, {"node", "mode"}, "rad/s", "abs(s)");
    create_growing("damping_ratio", ElementType::real, {"node", "mode"}, "1", "-Re(s)/abs(s)");
    create_growing("mode_shape", ElementType::complex, {"node", "mode", "coordinate"}, "1",
                   "mode shape in physical coordinates, unit M-norm");
    create_growing("residual", ElementType::real, {"node", "mode"}, "1",
                   "normwise backward error of the eigenpair, or of its block");
    create_growing("condition", ElementType::real, {"node", "mode"}, "1",
                   "relative condition number of the eigenvalue, or of its block");
    create_growing("equilibrium", ElementType::real, {"node", "coordinate"}, description.coordinate_units[0],
                   "steady equilibrium x0");
    if (has_constraints) {
      create_growing("multiplier", ElementType::real, {"node", "constraint"}, "1",
                     "Lagrange multiplier lambda0 (unit: force over gradient of the constraint)");
    }
    create_dense_output(unit);
    create_events(unit);
  }

  void create_dense_output(const std::string& unit) {
    create_growing("step_length", ElementType::real, {"step"}, "1",
                   "length of the step in the path's coordinate");
    create_growing("step_parameter", ElementType::real, {"step", "end", "order"}, unit,
                   "series of " + parameter + " in the path's coordinate at both ends");
    create_growing("dense_output", ElementType::complex, {"step", "function", "end", "order"}, "1",
                   "series of the smooth functions in the path's coordinate at both ends");
    create_growing("dense_block", ElementType::integer, {"step", "function"}, "1",
                   "block that the function belongs to, numbered by its first function; -1: not in use");
    create_growing("dense_chart", ElementType::integer, {"step", "function"}, "1",
                   "what the block follows: 0 for s, 1 for 1/s");
    create_growing("mode_block", ElementType::integer, {"step", "mode"}, "1",
                   "block that the mode belongs to on the step; -1: the mode does not exist there");
    create_growing(
        "certified", ElementType::integer, {"step", "mode"}, "1",
        "1: the mode is certified to be the same at both ends of the step; 0: it is not; -1: it does not "
        "exist there");
  }

  void create_events(const std::string& unit) {
    create_growing("events", ElementType::text, {"event"}, "1", "kind,parameter,real,imag,modes");
    create_growing("event_parameter", ElementType::real, {"event"}, unit, "value of " + parameter);
    create_growing("event_eigenvalue", ElementType::complex, {"event"}, "1/s", "eigenvalue s");
    create_growing("event_half_width", ElementType::real, {"event"}, unit,
                   "veering: distance of the exceptional point from the real " + parameter + " axis");
    create_growing(
        "event_puiseux", ElementType::complex, {"event"}, "1/s",
        "collision of m eigenvalues: s = s* + puiseux (" + parameter + " - " + parameter + "*)^(1/m)");
    create_growing("event_node", ElementType::integer, {"event"}, "1",
                   "first path point at or behind the event");
    create_growing("event_direction", ElementType::integer, {"event"}, "1",
                   "1: less stable with growing " + parameter +
                       ", resonance: the frequency outgrows the excitation, extremum: least damping; -1: the "
                       "reverse; 0: none");
    create_growing("event_value", ElementType::real, {"event"}, "1",
                   "damping ratio of a damping_ratio or an extremum, harmonic of a resonance");
    create_growing("event_shape", ElementType::complex, {"event", "coordinate"}, "1",
                   "mode shape in physical coordinates, unit M-norm");
    create_growing("event_sensitivity", ElementType::complex, {"event", "scene_parameter"},
                   "1/s per scene_parameter_unit", "ds/dq for every parameter q of the scene");
    create_growing("event_shift", ElementType::real, {"event", "scene_parameter"},
                   unit + " per scene_parameter_unit", "d" + parameter + "/dq: how the event moves");
  }

  /// Makes room for more modes or functions; what is in the file stays, with NaN in the new places.
  void grow(const std::string& dimension, std::size_t& current, std::size_t wanted) {
    if (wanted <= current) return;
    flush();
    if (dimension == "mode") {
      file.write_rows(dimension, current, mode_names(current, wanted));
    } else {
      file.write_rows(dimension, current, count_from(current, wanted - current));
    }
    for (const auto& [name, axis] : extensible[dimension]) file.extend(name, axis, wanted);
    current = wanted;
  }

  void append_modes(const TracePoint& point);
  void append_step(const PathStep& step);
  void flush();
};

LociWriter::LociWriter(const std::string& path, const Scene& scene, const Model& model,
                       const TraceOptions& options, const TraceStart& start) {
  write_complete(path, [&](const std::string& partial) {
    implementation_ =
        std::make_unique<Implementation>(Implementation{Hdf5File::create(partial), options.parameter});
    implementation_->n_modes = implementation_->n_functions = static_cast<std::size_t>(start.n_modes);
    Hdf5File& file = implementation_->file;
    write_provenance(file, loci_format, loci_schema_version, scene, options);
    file.set_attribute("reference", start.s_ref);
    file.set_attribute("series_order", static_cast<std::int64_t>(start.order));
    file.set_attribute("status", "running");
    implementation_->create_datasets(model, options, start.order);
    file.flush();
  });
}

LociWriter::~LociWriter() {
  try {
    if (implementation_) implementation_->flush();
  } catch (const std::exception& error) {
    // A destructor may not throw; what was flushed before is kept.
    std::fprintf(stderr, "eigentrail: the last points could not be written: %s\n", error.what());
  }
}

void LociWriter::Implementation::append_modes(const TracePoint& point) {
  const std::size_t begin = buffer.eigenvalue.size();
  const SystemMatrix& mass = point.node.linearization.M[0];
  last_shapes.resize(n_modes);
  buffer.eigenvalue.resize(begin + n_modes, Complex(nan, nan));
  buffer.eigenvalue_derivative.resize(begin + n_modes, Complex(nan, nan));
  for (auto* column : {&buffer.frequency, &buffer.damping_ratio, &buffer.residual, &buffer.condition})
    column->resize(begin + n_modes, nan);
  buffer.mode_shape.resize((begin + n_modes) * n_coordinates, Complex(nan, nan));
  for (const ModeState& state : point.modes) {
    const auto mode = static_cast<std::size_t>(state.mode);
    const std::size_t at = begin + mode;
    const double size = std::abs(state.s);
    buffer.eigenvalue[at] = state.s;
    buffer.eigenvalue_derivative[at] = state.slope;
    buffer.frequency[at] = size;
    buffer.damping_ratio[at] = std::isfinite(size) ? -state.s.real() / size + 0.0 : 0.0;
    buffer.residual[at] = state.backward_error;
    buffer.condition[at] = state.condition;
    ComplexVector& shape = last_shapes[mode];
    shape = normalize_shape(state.shape, mass, shape);
    std::copy(shape.begin(), shape.end(),
              buffer.mode_shape.begin() + static_cast<std::ptrdiff_t>(at * n_coordinates));
  }
}

void LociWriter::Implementation::append_step(const PathStep& step) {
  const std::size_t functions = buffer.steps() * n_functions;
  const std::size_t modes = buffer.steps() * n_modes;
  const auto orders = static_cast<std::size_t>(step.parameter.cols());
  buffer.step_length.push_back(step.length);
  for (Eigen::Index end = 0; end < 2; ++end) {
    for (Eigen::Index k = 0; k < step.parameter.cols(); ++k)
      buffer.step_parameter.push_back(step.parameter(end, k));
  }
  buffer.dense_output.resize((functions + n_functions) * 2 * orders, Complex(nan, nan));
  buffer.dense_block.resize(functions + n_functions, -1);
  buffer.dense_chart.resize(functions + n_functions, -1);
  buffer.mode_block.resize(modes + n_modes, -1);
  buffer.certified.resize(modes + n_modes, -1);
  std::size_t row = 0;
  for (const DenseBlock& block : step.blocks) {
    const auto number = static_cast<std::int64_t>(row);
    for (const int mode : block.modes) {
      buffer.mode_block[modes + static_cast<std::size_t>(mode)] = number;
      buffer.certified[modes + static_cast<std::size_t>(mode)] = block.certified ? 1 : 0;
    }
    for (Eigen::Index i = 0; i < block.left.rows(); ++i, ++row) {
      buffer.dense_block[functions + row] = number;
      buffer.dense_chart[functions + row] = block.chart == Chart::finite ? 0 : 1;
      std::size_t at = (functions + row) * 2 * orders;
      for (const ComplexMatrix* end : {&block.left, &block.right}) {
        for (Eigen::Index k = 0; k < end->cols(); ++k) buffer.dense_output[at++] = (*end)(i, k);
      }
    }
  }
}

void LociWriter::append(const TracePoint& point) {
  Implementation& self = *implementation_;
  std::size_t modes = self.n_modes;
  for (const ModeState& state : point.modes)
    modes = std::max(modes, static_cast<std::size_t>(state.mode) + 1);
  std::size_t functions = 0;
  if (point.step != nullptr) {
    for (const DenseBlock& block : point.step->blocks)
      functions += static_cast<std::size_t>(block.left.rows());
  }
  self.grow("mode", self.n_modes, modes);
  self.grow("function", self.n_functions, functions);
  if (point.step != nullptr) self.append_step(*point.step);
  self.append_modes(point);
  Buffer& buffer = self.buffer;
  buffer.parameter.push_back(point.node.p);
  const auto x = point.node.path.x.col(0);
  const auto lambda = point.node.path.lambda.col(0);
  buffer.equilibrium.insert(buffer.equilibrium.end(), x.begin(), x.end());
  buffer.multiplier.insert(buffer.multiplier.end(), lambda.begin(), lambda.end());
  const bool due = std::chrono::steady_clock::now() - self.last_flush > flush_interval;
  if (due || buffer.points() >= flush_nodes) self.flush();
}

void LociWriter::Implementation::flush() {
  const std::size_t n = buffer.points();
  last_flush = std::chrono::steady_clock::now();
  if (n == 0) return;
  file.write_rows("node", points, count_from(points, n));
  file.write_rows(parameter, points, buffer.parameter);
  file.write_rows("eigenvalue", points, buffer.eigenvalue);
  file.write_rows("eigenvalue_derivative", points, buffer.eigenvalue_derivative);
  file.write_rows("frequency", points, buffer.frequency);
  file.write_rows("damping_ratio", points, buffer.damping_ratio);
  file.write_rows("mode_shape", points, buffer.mode_shape);
  file.write_rows("residual", points, buffer.residual);
  file.write_rows("condition", points, buffer.condition);
  file.write_rows("equilibrium", points, buffer.equilibrium);
  if (has_constraints) file.write_rows("multiplier", points, buffer.multiplier);
  if (buffer.steps() > 0) {
    file.write_rows("step", steps, count_from(steps, buffer.steps()));
    file.write_rows("step_length", steps, buffer.step_length);
    file.write_rows("step_parameter", steps, buffer.step_parameter);
    file.write_rows("dense_output", steps, buffer.dense_output);
    file.write_rows("dense_block", steps, buffer.dense_block);
    file.write_rows("dense_chart", steps, buffer.dense_chart);
    file.write_rows("mode_block", steps, buffer.mode_block);
    file.write_rows("certified", steps, buffer.certified);
  }
  file.flush();
  points += n;
  steps += buffer.steps();
  buffer = {};
}

void LociWriter::finish(const TraceResult& result, const std::vector<StableRange>& ranges) {
  implementation_->flush();
  write_events(implementation_->file, result.events);
  write_stable_ranges(implementation_->file, implementation_->parameter, ranges);
  write_summary(implementation_->file, result);
  implementation_->file.flush();
}

}  // namespace eigentrail
