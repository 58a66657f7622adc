#include "eigentrail/store/loci_writer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "core/hdf5_writer.hpp"
#include "core/texts.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/whirl.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "store/labelled_datasets.hpp"
#include "store/loci_schema.hpp"
#include "store/loci_tables.hpp"
#include "store/marked_data.hpp"
#include "store/mode_motions.hpp"
#include "store/output_lock.hpp"
#include "store/provenance.hpp"
#include "store/whole_datasets.hpp"

namespace eigentrail {
namespace {

/// Writes the events from number `first` on to the datasets along the dimension `event`; those before have
/// been written already.
void write_events(Hdf5Writer& file, const std::vector<Event>& events, std::size_t first) {
  if (first >= events.size()) return;
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto write = [&](const char* name, auto field) {
    file.write_rows(name, first, column_of(std::span(events).subspan(first), field));
  };
  // A row is as long as the dimension; where an event has no such vector, it is not known.
  const auto row = [&file](const char* dimension, auto member) {
    return [size = static_cast<Eigen::Index>(file.shape(dimension)[0]), member](const Event& event) {
      auto values = event.*member;
      const Eigen::Index known = values.size();
      values.conservativeResize(size);
      if (known < size) values.tail(size - known).setConstant(nan);
      return values;
    };
  };
  write("event", [number = first](const Event&) mutable { return number++; });
  write("events", event_line);
  write("event_parameter", &Event::p);
  write("event_eigenvalue", &Event::s);
  write("event_half_width",
        [](const Event& event) { return event.kind == EventKind::veering ? event.half_width : nan; });
  write("event_puiseux",
        [](const Event& event) { return event.puiseux == 0.0 ? Complex(nan, nan) : event.puiseux; });
  write("event_node", &Event::node);
  write("event_direction", &Event::direction);
  write("event_value", &Event::value);
  write("event_shape", row("coordinate", &Event::shape));
  write("event_sensitivity", row("scene_parameter", &Event::sensitivity));
  write("event_shift", row("scene_parameter", &Event::shift));
}

/// Writes the root attributes on the outcome and the work of the trace.
void write_summary(Hdf5Writer& file, const TraceResult& result) {
  file.set_attribute("message", result.message);
  write_notes(file, result.notes);
  file.set_attribute("seconds", result.seconds);
  file.set_attribute("count_nodes", result.nodes);
  file.set_attribute("count_events", result.events.size());
  file.set_attribute("count_rejected_steps", result.rejections.total());
  file.set_attribute("count_modes_available", result.n_available);
  file.set_attribute("count_mode_steps", result.mode_steps);
  file.set_attribute("count_certified_mode_steps", result.certified_steps);
  file.set_attribute("count_mode_factorizations", result.counts.modes.factorizations);
  file.set_attribute("count_mode_iterations", result.counts.modes.iterations);
  file.set_attribute("count_mode_solves", result.counts.modes.solves);
  file.set_attribute("count_modal_bases", result.counts.modes.modal_bases);
  file.set_attribute("count_modal_solves", result.counts.modes.modal_solves);
  file.set_attribute("count_certificate_factorizations", result.counts.certificate_factorizations);
  file.set_attribute("count_certificate_bases", result.counts.certificate_bases);
  file.set_attribute("count_event_factorizations", result.counts.event_factorizations);
  file.set_attribute("count_spectra", result.counts.spectra);
  file.set_attribute("count_equilibrium_iterations", result.counts.equilibrium_iterations);
  file.set_attribute("count_equilibrium_factorizations", result.counts.equilibrium_factorizations);
}

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_rows = 256;  ///< points that are collected before they are written to the tables
constexpr double largest_share = 0.05;  ///< largest fraction of the time that may be spent on saving

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

void check_parameter_name(const Scene& scene, const std::string& parameter) {
  for (const std::string& name : trimmed_parameters(scene)) {
    if (is_loci_dataset(name))
      throw InputError(scene.path + ": [[trim]] unknown: a trimmed parameter cannot be called '" + name +
                       "', the loci file has a dataset of that name; rename it");
  }
  if (!is_loci_dataset(parameter)) return;
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
  SaveOptions saving;
  ModeMotions motions;
  std::vector<ComplexVector> last_shapes = {};  ///< per mode: its shape at the last point where it existed
  std::size_t events = 0;                       ///< number of events written so far
  Clock::time_point last_saved = Clock::now();
  double cost = 0.0;                         ///< seconds that the last save took
  std::string bytes = {};                    ///< what was saved, of a file that stays in memory
  std::vector<GivenName> wanted_names = {};  ///< of the scene, until the first point has come
  std::string scene_path = {};

  void append_point(const TracePoint& point);
  void append_modes(const TracePoint& point);
  void append_step(const PathStep& step);
  void update(const TraceResult& result, const char* status, bool is_last = false);
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
  file.set_attribute("series_order", start.order);
  if (!model.description().trims.empty())
    file.set_attribute("trimmed", joined(trimmed_names(model.description()), ","));
  std::string data;
  for (const auto& [label, text] : model.description().data) data += label + ": " + text + "\n";
  if (!data.empty()) file.set_attribute("model_data", data);
  create_dimensions(file, model, start.order, static_cast<std::size_t>(start.n_modes), motions);
  return {std::move(file), model, options};
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
                                           saving, std::move(motions)});
  implementation_->wanted_names = options.mode_names;
  implementation_->scene_path = scene.path;
}

LociWriter::LociWriter(const std::string& path, const Model& model, const TraceOptions& options,
                       const SavedTrace& saved, const SaveOptions& saving) {
  auto lock = lock_of(path, saving);
  const Hdf5Turn turn;
  LociTables tables(Hdf5Writer::from_image(path, saved.image), model, options);
  implementation_.reset(
      new Implementation{path, std::move(lock), std::move(tables), model, options.parameter, saving, {}});
  implementation_->saving.existing = Existing::replace;
  const std::string& other = saved.other_kernel;
  if (!other.empty() && !other.ends_with(blas_kernel()))
    implementation_->tables.file().set_attribute("blas_kernel", other + ", " + blas_kernel());
  try {
    unpack(saved.writer, implementation_->last_shapes, implementation_->motions, implementation_->events);
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

void LociWriter::Implementation::append_point(const TracePoint& point) {
  tables.begin_row("node");
  tables.row<double>(parameter)[0] = point.node.p;
  tables.row<std::int64_t>("growing_unfollowed")[0] = point.growing_unfollowed;
  std::ranges::copy(point.node.path.x.col(0), tables.row<double>("equilibrium").begin());
  const Eigen::Index m = model.n_constraints();
  const Vector lambda = point.node.path.lambda.col(0);
  if (m > 0) std::ranges::copy(lambda.head(m), tables.row<double>("multiplier").begin());
  const std::vector<std::string> trimmed = trimmed_names(model.description());
  for (std::size_t i = 0; i < trimmed.size(); ++i)
    tables.row<double>(trimmed[i])[0] = lambda[m + static_cast<Eigen::Index>(i)];
  append_modes(point);
}

void LociWriter::Implementation::append_modes(const TracePoint& point) {
  const auto eigenvalue = tables.row<Complex>("eigenvalue");
  const auto derivative = tables.row<Complex>("eigenvalue_derivative");
  const auto frequency = tables.row<double>("frequency");
  const auto damped_frequency = tables.row<double>("damped_frequency");
  const auto damping_ratio = tables.row<double>("damping_ratio");
  const auto residual = tables.row<double>("residual");
  const auto condition = tables.row<double>("condition");
  const auto rounding = tables.row<double>("rounding");
  const auto shapes = tables.row<Complex>("mode_shape");
  const bool spins = has_whirl(model.description());
  const Vector parameters = point.node.path.parameters.col(0);
  last_shapes.resize(tables.modes());
  for (const ModeState& state : point.modes) {
    const auto mode = static_cast<std::size_t>(state.mode);
    if (spins && state.s.imag() != 0.0) {
      const Whirl whirl = whirl_of(model, parameters, state.shape);
      tables.row<double>("whirl")[mode] = whirl.measure;
      tables.row<double>("whirl_reverse")[mode] = whirl.reverse;
    }
    const double size = std::abs(state.s);
    eigenvalue[mode] = state.s;
    derivative[mode] = state.slope;
    frequency[mode] = size;
    damped_frequency[mode] = std::abs(state.s.imag());
    damping_ratio[mode] = std::isfinite(size) ? -state.s.real() / size + 0.0 : 0.0;
    residual[mode] = state.backward_error;
    condition[mode] = state.condition;
    rounding[mode] = state.rounding;
    ComplexVector& shape = last_shapes[mode];
    shape = normalize_shape(state.shape, point.node.linearization.M[0], shape);
    const auto n = static_cast<std::size_t>(shape.size());
    std::ranges::copy(shape, shapes.subspan(mode * n, n).begin());
  }
}

void LociWriter::Implementation::append_step(const PathStep& step) {
  tables.begin_row("step");
  tables.row<double>("step_length")[0] = step.length;
  std::ranges::copy(row_major(step.parameter), tables.row<double>("step_parameter").begin());
  const std::vector<std::string> trimmed = trimmed_names(model.description());
  for (std::size_t i = 0; i < trimmed.size(); ++i)
    std::ranges::copy(row_major(step.trimmed[i]), tables.row<double>(step_dataset(trimmed[i])).begin());
  const auto output = tables.row<Complex>("dense_output");
  const auto dense_block = tables.row<std::int64_t>("dense_block");
  const auto dense_chart = tables.row<std::int64_t>("dense_chart");
  const auto mode_block = tables.row<std::int64_t>("mode_block");
  const auto certified = tables.row<std::int64_t>("certified");
  std::size_t row = 0;
  auto at = output.begin();
  for (const DenseBlock& block : step.blocks) {
    const auto number = static_cast<std::int64_t>(row);
    for (const int mode : block.modes) {
      mode_block[static_cast<std::size_t>(mode)] = number;
      certified[static_cast<std::size_t>(mode)] = block.certified ? 1 : 0;
    }
    for (Eigen::Index i = 0; i < block.left.rows(); ++i, ++row) {
      dense_block[row] = number;
      dense_chart[row] = block.chart == Chart::finite ? 0 : 1;
      for (const ComplexMatrix* end : {&block.left, &block.right})
        at = std::ranges::copy(end->row(i), at).out;
    }
  }
}

void LociWriter::append(const TracePoint& point) {
  Implementation& self = *implementation_;
  std::size_t modes = 0;
  for (const ModeState& state : point.modes)
    modes = std::max(modes, static_cast<std::size_t>(state.mode) + 1);
  self.tables.grow_modes(modes);
  if (point.step != nullptr) {
    std::size_t functions = 0;
    for (const DenseBlock& block : point.step->blocks)
      functions += static_cast<std::size_t>(block.left.rows());
    self.tables.grow_functions(functions);
    self.append_step(*point.step);
  }
  self.append_point(point);
  self.motions.append(point);
  if (!self.wanted_names.empty()) {
    self.motions.give_names(self.wanted_names, point, self.scene_path + ": [modes] names");
    self.wanted_names.clear();
  }
  if (self.tables.pending() >= most_rows) self.tables.write_rows();
}

/// Writes all that is new since the last save to the file in memory. `is_last`: nothing comes after it.
void LociWriter::Implementation::update(const TraceResult& result, const char* status, bool is_last) {
  tables.write_rows(is_last ? std::optional(result.events.size()) : std::nullopt);
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
  std::string image = tables.file().image();
  const std::string state =
      marked_data(image, packed(checkpoint.save(), packed(last_shapes, motions, events)));
  save(std::move(image), state);
  last_saved = Clock::now();
  cost = seconds_since(begin);
}

bool LociWriter::checkpoint(const Checkpoint& checkpoint) {
  Implementation& self = *implementation_;
  if (self.path.empty()) return false;
  const double interval = std::max(self.saving.interval, self.cost / largest_share);
  if (seconds_since(self.last_saved) < interval) return false;
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
    for (const std::string& name : datasets_of_events()) self.tables.file().extend(name, 0, 0);
    self.events = 0;
  }
  self.update(result, result.status == TraceStatus::completed ? "completed" : "ended early", true);
  const std::string unit = label_unit(self.model.description().parameters.at(self.parameter).unit);
  write_stable_ranges(self.tables.file(), unit, ranges);
  if (errors != nullptr) write_data_errors(self.tables.file(), unit, *errors);
  self.save(self.tables.file().image(), "");
}

}  // namespace eigentrail
