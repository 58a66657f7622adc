#include "eigentrail/store/accuracy_writer.hpp"

#include <algorithm>
#include <limits>

#include "core/hdf5_writer.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

void write_attributes(Hdf5Writer& file, const TraceSetup& setup, const StudyOptions& options,
                      const ReferenceSet& reference) {
  write_provenance(file, accuracy_format, accuracy_schema_version, setup.scene, setup.options);
  file.set_attribute("reference", reference.s_ref);
  file.set_attribute("reference_correction", reference.correction);
  file.set_attribute("reference_unsolved", reference.unsolved);
  file.set_attribute("repeat", options.repeat);
}

void write_runs(Hdf5Writer& file, const std::vector<MeasuredRun>& runs, const std::string& parameter_unit) {
  using Run = MeasuredRun;
  write_dimension(file, {"run", "1", "a method at one setting"}, counted(runs.size()));
  const auto write = [&](const DatasetLabel& label, auto field) {
    write_column(file, label, {"run"}, runs, field);
  };
  write({"method", "1", "what was run"}, run_name);
  write({"run_tolerance", "1", "tolerance asked for; NaN: none"}, &Run::tolerance);
  write({"order", "1", "order of the series; 0: none"}, &Run::order);
  write({"status", "1", "completed, or why the run ended early"},
        [](const Run& run) { return run.completed ? std::string("completed") : run.message; });
  write({"points", "1", "stored points or grid points"}, &Run::points);
  write({"error", "1", "largest relative error over the samples; NaN: not measured"}, [](const Run& run) {
    return run.measured > 0 ? run.error : std::numeric_limits<double>::quiet_NaN();
  });
  write({"error_parameter", parameter_unit, "where the largest error is"}, &Run::worst_parameter);
  write({"samples_measured", "1", "samples that the error was measured at"}, &Run::measured);
  write({"wall_time", "s", "median wall time"}, &Run::seconds);
  write({"factorizations", "1", "complex LU factorizations, all purposes"}, &Run::factorizations);
  write({"spectra", "1", "whole spectra by QZ"}, &Run::spectra);
  write({"evaluations", "1", "evaluations of the scene's effects"}, &Run::evaluations);
  write({"file_size", "byte", "size of the loci file; 0: none"}, &Run::bytes);
}

/// One row per passage of the path through a sample's parameter value.
void write_references(Hdf5Writer& file, const ReferenceSet& reference, const std::string& parameter_unit) {
  std::vector<double> parameters;
  std::vector<const std::vector<Complex>*> rows;
  std::size_t modes = 0;
  for (const ReferenceSample& sample : reference.samples) {
    for (const std::vector<Complex>& passage : sample.passages) {
      parameters.push_back(sample.p);
      rows.push_back(&passage);
      modes = std::max(modes, passage.size());
    }
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Complex> values;
  for (const std::vector<Complex>* row : rows) {
    values.insert(values.end(), row->begin(), row->end());
    values.resize(values.size() + modes - row->size(), Complex(nan, nan));
  }
  write_dimension(file, {"sample", "1", "a place where errors are measured"}, counted(rows.size()));
  write_dimension(file, {"mode", "1", "reference eigenvalue, in no particular order"}, counted(modes));
  write_dataset(file, {"sample_parameter", parameter_unit, "traced parameter at the sample"}, {"sample"},
                parameters);
  write_dataset(
      file, {"reference_eigenvalue", "1/s", "eigenvalue with Im >= 0, computed with 113 bits and rounded"},
      {"sample", "mode"}, values);
}

}  // namespace

std::string study_file(const TraceSetup& setup, const StudyOptions& options, const Study& study) {
  const std::string unit = label_unit(setup.scene.parameters.at(setup.options.parameter).unit);
  Hdf5Writer file = Hdf5Writer::in_memory("work-precision study");
  write_attributes(file, setup, options, study.reference);
  write_runs(file, study.runs, unit);
  write_references(file, study.reference, unit);
  return file.image();
}

}  // namespace eigentrail
