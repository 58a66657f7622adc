#include "eigentrail/store/loci_writer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/modes/normalization.hpp"
#include "eigentrail/modes/whirl.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "store/data_error_datasets.hpp"
#include "store/loci_schema.hpp"
#include "store/loci_summary.hpp"
#include "store/loci_tables.hpp"
#include "store/mode_motions.hpp"
#include "store/output_lock.hpp"
#include "store/projection_datasets.hpp"
#include "store/provenance.hpp"
#include "store/range_datasets.hpp"
#include "store/saved_state.hpp"
#include "store/shaft_datasets.hpp"

namespace eigentrail {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_rows = 256;  ///< points that are collected before they are written to the tables
constexpr double largest_share = 0.05;  ///< largest fraction of the time that may be spent on saving
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

bool has_dataset_name(const std::string& parameter) {
  return is_loci_dataset(parameter) || is_range_dataset(parameter) || is_data_error_dataset(parameter) ||
         is_projection_dataset(parameter) || is_shaft_dataset(parameter);
}

}  // namespace

void check_parameter_name(const Scene& scene, const std::string& parameter) {
  for (const std::string& name : trimmed_parameters(scene)) {
    if (has_dataset_name(name))
      throw InputError(scene.path + ": [[trim]] unknown: a trimmed parameter cannot be called '" + name +
                       "', the loci file has a dataset of that name; rename it");
  }
  if (!has_dataset_name(parameter)) return;
  SourceLocation where;
  for (const Table* trace : tables(scene, "trace")) {
    if (const Value* key = trace->find("parameter")) where = key->where;
  }
  throw scene_error(scene, where,
                    "[trace] parameter: the traced parameter cannot be called '" + parameter +
                        "', the loci file has a dataset of that name; rename it");
}

struct LociWriter::Implementation {
  std::string path;                  ///< empty: the file stays in memory
  std::unique_ptr<OutputLock> lock;  ///< null: none
  LociTables tables;
  const Model& model;
  std::string parameter;
  std::size_t coordinates;
  SaveOptions saving;
  ModeMotions motions;
  LociRows rows = {};
  std::vector<ComplexVector> last_shapes = {};  ///< per mode: its shape at the last point where it existed
  std::size_t events = 0;                       ///< number of events written so far
  bool is_saved = false;                        ///< whether this run has saved the file
  Clock::time_point last_saved = Clock::now();
  double cost = 0.0;                         ///< seconds that the last save took
  std::string bytes = {};                    ///< what was saved, of a file that stays in memory
  std::vector<GivenName> wanted_names = {};  ///< of the scene, until the first point has come
  std::string scene_path = {};

  void append_modes(const TracePoint& point);
  void append_step(const PathStep& step);
  void write_rows();
  void update(const TraceResult& result, const char* status);
  void save(const Checkpoint& checkpoint, const char* status);
  void save(std::string image, std::string_view state);
};

namespace {

std::unique_ptr<OutputLock> lock_of(const std::string& path, const SaveOptions& saving) {
  return saving.lock && !path.empty() ? std::make_unique<OutputLock>(path) : nullptr;
}

LociTables new_tables(const std::string& path, const Scene& scene, const Model& model,
                      const TraceOptions& options, const TraceStart& start,
                      const std::vector<std::string>& motions) {
  Hdf5Writer file = Hdf5Writer::in_memory(path.empty() ? "loci file" : path);
  write_provenance(file, loci_format, loci_schema_version, scene, options);
  file.set_attribute("reference", start.s_ref);
  file.set_attribute("series_order", static_cast<std::int64_t>(start.order));
  if (const std::string trimmed = trimmed_list(model.description()); !trimmed.empty())
    file.set_attribute("trimmed", trimmed);
  std::string data;
  for (const auto& [label, text] : model.description().data) data += label + ": " + text + "\n";
  if (!data.empty()) file.set_attribute("model_data", data);
  return {std::move(file), model, options, start.order, static_cast<std::size_t>(start.n_modes), motions};
}

}  // namespace

LociWriter::LociWriter(const std::string& path, const Scene& scene, const Model& model,
                       const TraceOptions& options, const TraceStart& start, const TracePoint& first,
                       const SaveOptions& saving) {
  auto lock = lock_of(path, saving);
  if (!path.empty()) check_can_create(path);
  ModeMotions motions(model, first);
  const Hdf5Turn turn;
  LociTables tables = new_tables(path, scene, model, options, start, motions.labels());
  implementation_.reset(new Implementation{path, std::move(lock), std::move(tables), model, options.parameter,
                                           static_cast<std::size_t>(model.n_coordinates()), saving,
                                           std::move(motions)});
  implementation_->wanted_names = options.mode_names;
  implementation_->scene_path = scene.path;
}

LociWriter::LociWriter(const std::string& path, const Model& model, const TraceOptions& options,
                       const SavedTrace& saved, const SaveOptions& saving) {
  auto lock = lock_of(path, saving);
  const Hdf5Turn turn;
  LociTables tables(Hdf5Writer::from_image(path, saved.image), model, options);
  implementation_.reset(new Implementation{path,
                                           std::move(lock),
                                           std::move(tables),
                                           model,
                                           options.parameter,
                                           static_cast<std::size_t>(model.n_coordinates()),
                                           saving,
                                           {}});
  implementation_->saving.existing = Existing::replace;
  const std::string& other = saved.other_kernel;
  if (!other.empty() && !other.ends_with(blas_kernel()))
    implementation_->tables.file().set_attribute("blas_kernel", other + ", " + blas_kernel());
  try {
    ArchiveReader archive(saved.writer);
    archive(implementation_->last_shapes, implementation_->motions, implementation_->events);
    archive.finish();
  } catch (const ArchiveError& error) {
    throw InputError(path + ": the state of the trace is damaged: " + error.what());
  }
  implementation_->motions.belongs_to(model);
  for (const ComplexVector& shape : implementation_->last_shapes) {
    if (shape.size() != 0 && shape.size() != model.n_coordinates())
      throw InputError(path + ": the state of the trace does not fit the scene: other mode shapes");
  }
  if (!implementation_->motions.fits(model.description()))
    throw InputError(path + ": the state of the trace does not fit the scene: other motions");
}

LociWriter::~LociWriter() {
  const Hdf5Turn turn;
  implementation_.reset();
}

void LociWriter::Implementation::append_modes(const TracePoint& point) {
  const std::size_t begin = rows.eigenvalue.size();
  const SystemMatrix& mass = point.node.linearization.M[0];
  last_shapes.resize(tables.modes());
  rows.eigenvalue.resize(begin + tables.modes(), Complex(nan, nan));
  rows.eigenvalue_derivative.resize(begin + tables.modes(), Complex(nan, nan));
  for (auto* column : {&rows.frequency, &rows.damped_frequency, &rows.damping_ratio, &rows.residual,
                       &rows.condition, &rows.rounding})
    column->resize(begin + tables.modes(), nan);
  rows.mode_shape.resize((begin + tables.modes()) * coordinates, Complex(nan, nan));
  const bool spins = has_whirl(model.description());
  if (spins) {
    rows.whirl.resize(begin + tables.modes(), nan);
    rows.whirl_reverse.resize(begin + tables.modes(), nan);
  }
  const Vector parameters = point.node.path.parameters.col(0);
  for (const ModeState& state : point.modes) {
    const auto mode = static_cast<std::size_t>(state.mode);
    const std::size_t at = begin + mode;
    if (spins && state.s.imag() != 0.0) {
      const Whirl whirl = whirl_of(model, parameters, state.shape);
      rows.whirl[at] = whirl.measure;
      rows.whirl_reverse[at] = whirl.reverse;
    }
    const double size = std::abs(state.s);
    rows.eigenvalue[at] = state.s;
    rows.eigenvalue_derivative[at] = state.slope;
    rows.frequency[at] = size;
    rows.damped_frequency[at] = std::abs(state.s.imag());
    rows.damping_ratio[at] = std::isfinite(size) ? -state.s.real() / size + 0.0 : 0.0;
    rows.residual[at] = state.backward_error;
    rows.condition[at] = state.condition;
    rows.rounding[at] = state.rounding;
    ComplexVector& shape = last_shapes[mode];
    shape = normalize_shape(state.shape, mass, shape);
    std::copy(shape.begin(), shape.end(),
              rows.mode_shape.begin() + static_cast<std::ptrdiff_t>(at * coordinates));
  }
}

void LociWriter::Implementation::append_step(const PathStep& step) {
  const std::size_t functions = rows.steps() * tables.functions();
  const std::size_t modes = rows.steps() * tables.modes();
  const auto orders = static_cast<std::size_t>(step.parameter.cols());
  rows.step_length.push_back(step.length);
  for (Eigen::Index end = 0; end < 2; ++end) {
    for (Eigen::Index k = 0; k < step.parameter.cols(); ++k)
      rows.step_parameter.push_back(step.parameter(end, k));
  }
  rows.step_trimmed.resize(step.trimmed.size());
  for (std::size_t i = 0; i < step.trimmed.size(); ++i) {
    for (Eigen::Index end = 0; end < 2; ++end) {
      const auto series = step.trimmed[i].row(end);
      rows.step_trimmed[i].insert(rows.step_trimmed[i].end(), series.begin(), series.end());
    }
  }
  rows.dense_output.resize((functions + tables.functions()) * 2 * orders, Complex(nan, nan));
  rows.dense_block.resize(functions + tables.functions(), -1);
  rows.dense_chart.resize(functions + tables.functions(), -1);
  rows.mode_block.resize(modes + tables.modes(), -1);
  rows.certified.resize(modes + tables.modes(), -1);
  std::size_t row = 0;
  for (const DenseBlock& block : step.blocks) {
    const auto number = static_cast<std::int64_t>(row);
    for (const int mode : block.modes) {
      rows.mode_block[modes + static_cast<std::size_t>(mode)] = number;
      rows.certified[modes + static_cast<std::size_t>(mode)] = block.certified ? 1 : 0;
    }
    for (Eigen::Index i = 0; i < block.left.rows(); ++i, ++row) {
      rows.dense_block[functions + row] = number;
      rows.dense_chart[functions + row] = block.chart == Chart::finite ? 0 : 1;
      std::size_t at = (functions + row) * 2 * orders;
      for (const ComplexMatrix* end : {&block.left, &block.right}) {
        for (Eigen::Index k = 0; k < end->cols(); ++k) rows.dense_output[at++] = (*end)(i, k);
      }
    }
  }
}

void LociWriter::append(const TracePoint& point) {
  Implementation& self = *implementation_;
  std::size_t modes = 0;
  for (const ModeState& state : point.modes)
    modes = std::max(modes, static_cast<std::size_t>(state.mode) + 1);
  std::size_t functions = 0;
  if (point.step != nullptr) {
    for (const DenseBlock& block : point.step->blocks)
      functions += static_cast<std::size_t>(block.left.rows());
  }
  if (modes > self.tables.modes() || functions > self.tables.functions()) {
    self.write_rows();
    self.tables.grow_modes(modes);
    self.tables.grow_functions(functions);
  }
  if (point.step != nullptr) self.append_step(*point.step);
  self.append_modes(point);
  self.motions.append(point);
  if (!self.wanted_names.empty()) {
    self.motions.give_names(self.wanted_names, point, self.scene_path + ": [modes] names");
    self.wanted_names.clear();
  }
  LociRows& rows = self.rows;
  rows.parameter.push_back(point.node.p);
  rows.growing_unfollowed.push_back(point.growing_unfollowed);
  const auto x = point.node.path.x.col(0);
  const auto lambda = point.node.path.lambda.col(0);
  rows.equilibrium.insert(rows.equilibrium.end(), x.begin(), x.end());
  const auto m = lambda.begin() + self.model.n_constraints();
  rows.multiplier.insert(rows.multiplier.end(), lambda.begin(), m);
  rows.trimmed.resize(static_cast<std::size_t>(self.model.n_trims()));
  for (std::size_t i = 0; i < rows.trimmed.size(); ++i)
    rows.trimmed[i].push_back(m[static_cast<std::ptrdiff_t>(i)]);
  if (rows.points() >= most_rows) self.write_rows();
}

void LociWriter::Implementation::write_rows() {
  const Hdf5Turn turn;
  tables.append(rows);
  rows = {};
}

/// Writes all that is new since the last save to the file in memory.
void LociWriter::Implementation::update(const TraceResult& result, const char* status) {
  write_rows();
  Hdf5Writer& file = tables.file();
  write_events(file, result.events, events);
  events = result.events.size();
  motions.write(file, tables.modes());
  write_summary(file, result);
  file.set_attribute("status", status);
}

void LociWriter::Implementation::save(std::string image, std::string_view state) {
  try {
    if (path.empty()) {
      bytes = std::move(image.append(state));
    } else {
      write_durably(path, {image, state}, saving.existing);
      saving.existing = Existing::replace;
    }
  } catch (const std::exception& error) {
    throw WriteError(error.what());
  }
}

void LociWriter::Implementation::save(const Checkpoint& checkpoint, const char* status) {
  const Hdf5Turn turn;
  const auto begin = Clock::now();
  update(checkpoint.so_far(), status);
  ArchiveWriter archive;
  archive(last_shapes, motions, events);
  std::string image = tables.file().image();
  const std::string state = saved_state(image, checkpoint.save(), archive.bytes());
  save(std::move(image), state);
  is_saved = true;
  last_saved = Clock::now();
  cost = seconds_since(begin);
}

bool LociWriter::checkpoint(const Checkpoint& checkpoint) {
  Implementation& self = *implementation_;
  if (self.path.empty()) return false;
  const double interval = std::max(self.saving.interval, self.cost / largest_share);
  if (self.is_saved && seconds_since(self.last_saved) < interval) return false;
  self.save(checkpoint, "running");
  return true;
}

void LociWriter::interrupt(const Checkpoint& checkpoint) {
  implementation_->save(checkpoint, "interrupted");
}

const std::string& LociWriter::bytes() const {
  return implementation_->bytes;
}

std::vector<std::string> LociWriter::mode_names() const {
  return implementation_->motions.names(implementation_->tables.modes());
}

void LociWriter::finish(const TraceResult& result, const std::vector<StableRange>& ranges,
                        const DataErrors* errors) {
  Implementation& self = *implementation_;
  const Hdf5Turn turn;
  // With errors of the data, events that were written may have been taken back.
  if (errors != nullptr && self.events > 0) {
    clear_events(self.tables.file());
    self.events = 0;
  }
  self.update(result, result.status == TraceStatus::completed ? "completed" : "ended early");
  write_stable_ranges(self.tables.file(), self.parameter, ranges);
  if (errors != nullptr) write_data_errors(self.tables.file(), self.parameter, *errors);
  self.save(self.tables.file().image(), "");
}

}  // namespace eigentrail
