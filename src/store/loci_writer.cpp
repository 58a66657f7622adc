#include "eigentrail/store/loci_writer.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/version.hpp"
#include "eigentrail/modes/normalization.hpp"

namespace eigentrail {
namespace {

constexpr auto flush_interval = std::chrono::seconds(1);
constexpr std::size_t flush_nodes = 256;

const std::array<std::string, 17> reserved = {"node",
                                              "mode",
                                              "coordinate",
                                              "constraint",
                                              "order",
                                              "eigenvalue",
                                              "eigenvalue_derivative",
                                              "frequency",
                                              "damping_ratio",
                                              "mode_shape",
                                              "residual",
                                              "condition",
                                              "equilibrium",
                                              "multiplier",
                                              "eigenvalue_series",
                                              "events",
                                              "block"};

std::vector<std::int64_t> count_from(std::int64_t first, std::size_t n) {
  std::vector<std::int64_t> list(n);
  for (std::size_t i = 0; i < n; ++i) list[i] = first + static_cast<std::int64_t>(i);
  return list;
}

/// Points that wait to be written, one array per dataset, row-major.
struct Buffer {
  std::vector<double> parameter, frequency, damping_ratio, residual, condition, equilibrium, multiplier;
  std::vector<Complex> eigenvalue, eigenvalue_derivative, eigenvalue_series, mode_shape;
};

}  // namespace

void check_parameter_name(const Scene& scene, const std::string& parameter) {
  if (std::find(reserved.begin(), reserved.end(), parameter) == reserved.end()) return;
  SourceLocation where;
  for (const Table* trace : tables(scene, "trace")) {
    if (const Value* key = trace->find("parameter")) where = key->where;
  }
  throw scene_error(scene, where,
                    "[trace] parameter: the traced parameter cannot be called '" + parameter +
                        "', the loci file has a dataset of that name; rename it");
}

bool may_be_replaced(const std::string& path) {
  try {
    const Hdf5File file = Hdf5File::open(path);
    return file.has_attribute("format") && file.text_attribute("format") == "eigentrail-loci";
  } catch (const Hdf5Error&) {
    return false;
  }
}

struct LociWriter::Implementation {
  Hdf5File file;
  std::string parameter;
  bool has_constraints = false;
  Buffer buffer = {};
  std::uint64_t written = 0;
  std::chrono::steady_clock::time_point last_flush = std::chrono::steady_clock::now();
  std::vector<ComplexVector> last_shapes = {};

  /// A dataset whose first dimension grows by one row per point, with its dimension scales.
  void create_growing(const std::string& name, ElementType type, const std::vector<std::string>& dimensions,
                      const std::string& units, const std::string& long_name, bool is_parameter = false) {
    Shape shape{0};
    for (std::size_t d = 1; d < dimensions.size(); ++d) shape.push_back(file.shape(dimensions[d])[0]);
    std::map<std::string, std::string> attributes{{"units", units}, {"long_name", long_name}};
    if (!is_parameter) attributes["coordinates"] = parameter;  // CF: the auxiliary coordinate along `node`
    file.create_dataset({name, type, shape, true, attributes});
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      file.attach_scale(name, dimensions[d], static_cast<unsigned>(d));
    }
  }

  /// A fixed dimension with its labels.
  template <class Label>
  void create_dimension(const std::string& name, ElementType type, const std::vector<Label>& labels,
                        const std::string& long_name) {
    file.create_dataset({name, type, {labels.size()}, false, {{"units", "1"}, {"long_name", long_name}}});
    file.write_rows(name, 0, labels);
    file.make_scale(name, name);
  }

  void create_datasets(const Model& model, const TraceOptions& options, int n_modes) {
    const ModelDescription& description = model.description();
    const Parameter& traced = description.parameters.at(options.parameter);
    const std::string unit = traced.unit.empty() ? "1" : traced.unit;
    has_constraints = model.n_constraints() > 0;

    std::vector<std::string> modes(static_cast<std::size_t>(n_modes));
    for (std::size_t i = 0; i < modes.size(); ++i) modes[i] = "mode " + std::to_string(i + 1);
    file.create_dataset(
        {"node", ElementType::integer, {0}, true, {{"units", "1"}, {"long_name", "path point"}}});
    file.make_scale("node", "node");
    create_dimension("mode", ElementType::text, modes, "mode");
    create_dimension("coordinate", ElementType::text, description.coordinate_names, "coordinate");
    create_dimension("order", ElementType::integer,
                     count_from(0, static_cast<std::size_t>(options.order) + 1),
                     "power of the distance from the point");
    if (has_constraints)
      create_dimension("constraint", ElementType::text, description.constraint_names, "constraint");

    const std::string per_unit = unit == "1" ? "1/s" : "1/s/(" + unit + ")";
    create_growing(parameter, ElementType::real, {"node"}, unit, "traced parameter " + parameter, true);
    create_growing("eigenvalue", ElementType::complex, {"node", "mode"}, "1/s", "eigenvalue s");
    create_growing("eigenvalue_derivative", ElementType::complex, {"node", "mode"}, per_unit,
                   "ds/d" + parameter);
    create_growing("eigenvalue_series", ElementType::complex, {"node", "mode", "order"},
                   "1/s/(" + unit + ")^order",
                   "Taylor coefficients of s(" + parameter +
                       ") at the point; two neighbouring points give the dense output");
    create_growing("frequency", ElementType::real, {"node", "mode"}, "rad/s", "abs(s)");
    create_growing("damping_ratio", ElementType::real, {"node", "mode"}, "1", "-Re(s)/abs(s)");
    create_growing("mode_shape", ElementType::complex, {"node", "mode", "coordinate"}, "1",
                   "mode shape in physical coordinates, unit M-norm");
    create_growing("residual", ElementType::real, {"node", "mode"}, "1",
                   "normwise backward error of the eigenpair");
    create_growing("condition", ElementType::real, {"node", "mode"}, "1",
                   "relative condition number of the eigenvalue");
    create_growing("equilibrium", ElementType::real, {"node", "coordinate"}, description.coordinate_units[0],
                   "steady equilibrium x0");
    if (has_constraints) {
      create_growing("multiplier", ElementType::real, {"node", "constraint"}, "1",
                     "Lagrange multiplier lambda0 (unit: force over gradient of the constraint)");
    }
  }
};

LociWriter::LociWriter(const std::string& path, const Scene& scene, const Model& model,
                       const TraceOptions& options, const TraceStart& start, int n_modes) {
  // A name of this process alone: nothing that stands there is touched.
  const std::string partial = path + ".partial." + std::to_string(getpid());
  implementation_ =
      std::make_unique<Implementation>(Implementation{Hdf5File::create(partial), options.parameter});
  try {
    Hdf5File& file = implementation_->file;
    file.set_attribute("format", "eigentrail-loci");
    file.set_attribute("schema_version", std::int64_t{loci_schema_version});
    file.set_attribute("program_version", version());
    file.set_attribute("title", scene.title);
    file.set_attribute("scene", scene.text);
    file.set_attribute("scene_path", scene.path);
    file.set_attribute("parameter", options.parameter);
    file.set_attribute("tolerance", options.tolerance);
    file.set_attribute("reference", start.s_ref);
    for (const auto& [key, text] : describe_options(options)) file.set_attribute("option_" + key, text);
    file.set_attribute("status", "running");
    implementation_->create_datasets(model, options, n_modes);
    file.flush();
    std::filesystem::rename(partial, path);
  } catch (...) {
    implementation_.reset();
    std::remove(partial.c_str());
    throw;
  }
}

LociWriter::~LociWriter() {
  try {
    if (implementation_) flush();
  } catch (const std::exception& error) {
    // A destructor may not throw; what was flushed before is kept.
    std::fprintf(stderr, "eigentrail: the last points could not be written: %s\n", error.what());
  }
}

void LociWriter::append(const PathNode& node) {
  Implementation& self = *implementation_;
  Buffer& buffer = self.buffer;
  const Eigen::Index n_modes = node.s.rows();
  self.last_shapes.resize(static_cast<std::size_t>(n_modes));
  buffer.parameter.push_back(node.p);
  for (Eigen::Index i = 0; i < n_modes; ++i) {
    // A pair is followed smoothly by one member, also where that one crosses the real axis; it is reported by
    // the member with Im s >= 0.
    const bool lower = node.s(i, 0).imag() < 0.0;
    const auto member = [lower](Complex z) { return lower ? std::conj(z) : z; };
    const Complex s = member(node.s(i, 0));
    buffer.eigenvalue.push_back(s);
    buffer.eigenvalue_derivative.push_back(member(node.s(i, 1)));
    for (Eigen::Index k = 0; k < node.s.cols(); ++k) buffer.eigenvalue_series.push_back(node.s(i, k));
    buffer.frequency.push_back(std::abs(s));
    buffer.damping_ratio.push_back(-s.real() / std::abs(s) + 0.0);
    buffer.residual.push_back(node.backward_error[i]);
    buffer.condition.push_back(node.condition[i]);
    ComplexVector& shape = self.last_shapes[static_cast<std::size_t>(i)];
    shape = normalize_shape(node.shapes[static_cast<std::size_t>(i)].col(0), node.mass, shape);
    for (const Complex component : shape) buffer.mode_shape.push_back(member(component));
  }
  const auto x = node.path.x.col(0);
  const auto lambda = node.path.lambda.col(0);
  buffer.equilibrium.insert(buffer.equilibrium.end(), x.begin(), x.end());
  buffer.multiplier.insert(buffer.multiplier.end(), lambda.begin(), lambda.end());
  const bool due = std::chrono::steady_clock::now() - self.last_flush > flush_interval;
  if (due || buffer.parameter.size() >= flush_nodes) flush();
}

void LociWriter::flush() {
  Implementation& self = *implementation_;
  Hdf5File& file = self.file;
  const Buffer& buffer = self.buffer;
  const std::size_t n = buffer.parameter.size();
  self.last_flush = std::chrono::steady_clock::now();
  if (n == 0) return;
  file.write_rows("node", self.written, count_from(static_cast<std::int64_t>(self.written), n));
  file.write_rows(self.parameter, self.written, buffer.parameter);
  file.write_rows("eigenvalue", self.written, buffer.eigenvalue);
  file.write_rows("eigenvalue_derivative", self.written, buffer.eigenvalue_derivative);
  file.write_rows("eigenvalue_series", self.written, buffer.eigenvalue_series);
  file.write_rows("frequency", self.written, buffer.frequency);
  file.write_rows("damping_ratio", self.written, buffer.damping_ratio);
  file.write_rows("mode_shape", self.written, buffer.mode_shape);
  file.write_rows("residual", self.written, buffer.residual);
  file.write_rows("condition", self.written, buffer.condition);
  file.write_rows("equilibrium", self.written, buffer.equilibrium);
  if (self.has_constraints) file.write_rows("multiplier", self.written, buffer.multiplier);
  file.flush();
  self.written += n;
  self.buffer = {};
}

void LociWriter::finish(const TraceResult& result) {
  flush();
  Hdf5File& file = implementation_->file;
  const auto count = [&file](const std::string& name, std::uint64_t value) {
    file.set_attribute("count_" + name, static_cast<std::int64_t>(value));
  };
  file.set_attribute("status", result.status == TraceStatus::completed ? "completed" : "ended early");
  file.set_attribute("message", result.message);
  file.set_attribute("seconds", result.seconds);
  count("nodes", static_cast<std::uint64_t>(result.nodes));
  count("rejected_steps", static_cast<std::uint64_t>(result.rejections.total()));
  count("modes_available", static_cast<std::uint64_t>(result.n_available));
  count("mode_factorizations", result.counts.modes.factorizations);
  count("mode_iterations", result.counts.modes.iterations);
  count("mode_solves", result.counts.modes.solves);
  count("equilibrium_iterations", result.counts.equilibrium_iterations);
  count("equilibrium_factorizations", result.counts.equilibrium_factorizations);
  file.flush();
}

}  // namespace eigentrail
