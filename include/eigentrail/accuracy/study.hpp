// Work-precision study of a scene: the measured error and the cost of traces with this program, and of other
// methods on a grid of the parameter ("rivals").
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/accuracy/reference.hpp"
#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/core/workers.hpp"

namespace eigentrail {

struct StudyOptions {
  std::vector<double> tolerances = {1e-2, 1e-3, 1e-4,  1e-5,  1e-6, 1e-7,
                                    1e-8, 1e-9, 1e-10, 1e-11, 1e-12};  ///< 1e-13 <= . <= 0.1
  std::vector<int> orders = {1, 2, 3, 4};                              ///< 1 to 4
  std::vector<int> grids = {25, 50, 100, 200, 400, 800};  ///< points of the grids, >= 5; may be empty
  int samples = 200;                                      ///< parameters at which errors are measured, >= 1
  int repeat = 5;                                         ///< runs whose median wall time counts, >= 1
};

/// One message for every member that violates its bounds, which include upper limits of 1,000,000 grid points
/// and samples and 1000 repetitions. Empty if the options are valid.
std::vector<std::string> find_faults(const StudyOptions& options);

/// Reference eigenvalues at one parameter value, for every passage of the path.
struct ReferenceSample {
  double p = 0.0;
  std::vector<std::vector<Complex>> passages;  ///< finite eigenvalues, one per complex pair, nearest doubles
};

struct ReferenceSet {
  std::vector<ReferenceSample> samples;  ///< samples with a reference, by ascending p
  int unsolved = 0;                      ///< number of parameter values without a reference
  double correction = 0.0;               ///< largest last correction, relative: the error of the references
  double s_ref = 1.0;                    ///< errors are relative to max(|s|, s_ref), 1/s
};

/// Method that computes eigenvalues over the range of the parameter.
enum class Method {
  trace,              ///< this program
  trace_uncertified,  ///< this program without certificate
  qz,                 ///< QZ at every grid point, modes matched by modal assurance and optimal assignment
  zero_order,         ///< corrector on a grid, started from the modes of the last point
  secant,             ///< corrector on a grid, started from the secant through the last two points
  tangent             ///< corrector on a grid, started from the tangent at the last point
};

/// Interpolation between the points of a grid.
enum class Interpolation { linear, cubic_spline };

/// Errors and cost of a method at one setting.
struct MeasuredRun {
  Method method = Method::trace;
  std::optional<Interpolation> interpolation;  ///< for grids only
  double tolerance = 0.0;                      ///< of a trace; NaN for grids
  int order = 0;                               ///< of the series of a trace; 0 for grids
  bool completed = false;                      ///< whether the end of the range was reached
  std::string message;                         ///< reason if not completed
  int points = 0;                              ///< number of nodes or grid points
  double error = 0.0;                          ///< largest error of all samples (spectrum_distance.hpp)
  double worst_parameter = 0.0;                ///< parameter value of the largest error
  int measured = 0;                            ///< number of samples with a measured error
  double seconds = 0.0;                        ///< median wall time
  std::uint64_t factorizations = 0;            ///< complex LU of about the pencil's size, all purposes
  std::uint64_t spectra = 0;                   ///< full spectra by QZ
  std::uint64_t evaluations = 0;               ///< evaluations of effects: residuals and linearizations
  std::uint64_t bytes = 0;                     ///< size of the loci file; 0 for grids
};

/// Name of a method, for example "corrector, secant".
std::string method_name(Method method);
/// Name of the method and interpolation of a run, for example "QZ, cubic spline".
std::string run_name(const MeasuredRun& run);

struct [[nodiscard]] Study {
  ReferenceSet reference;
  std::vector<MeasuredRun> runs;  ///< traces, then two for each grid: linear interpolation, cubic spline
};

/// `count` parameter values in the range of the options, from the golden-ratio sequence; ascending.
std::vector<double> sample_parameters(const TraceOptions& options, int count);

/// References at the parameter values. A trace with tolerance 1e-10 gives the starting values for the
/// equilibria. Throws InputError if the trace cannot be started.
ReferenceSet reference_set(const TraceSetup& setup, const std::vector<double>& parameters);

/// Traces the scene with the setup's options and measures error and cost. `repeat`: number of timed runs.
MeasuredRun measure_trace(const TraceSetup& setup, const ReferenceSet& reference, int repeat);

/// The same grid with both interpolations. Both have the wall time of the grid points.
struct GridRuns {
  MeasuredRun linear, spline;
};

/// Runs another method on an equidistant grid, for the modes that a trace follows, and measures error and
/// cost. `repeat`: number of timed runs.
GridRuns measure_grid(const TraceSetup& setup, const ReferenceSet& reference, Method method, int points,
                      int repeat);

/// The whole study. `progress` is called with the number of finished runs and the number of all runs.
/// `workers` compute one piece at a time. The options of `setup` are changed during the study and restored at
/// the end.
Study accuracy_study(TraceSetup& setup, const StudyOptions& options, Workers& workers,
                     const std::function<void(int, int)>& progress);

}  // namespace eigentrail
