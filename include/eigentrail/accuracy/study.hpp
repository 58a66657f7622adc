// Work-precision study of a scene: which error is really achieved at which cost, by this program and by what
// would be done without it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/accuracy/reference.hpp"
#include "eigentrail/continuation/recorded_path.hpp"

namespace eigentrail {

struct StudyOptions {
  std::vector<double> tolerances = {1e-2, 1e-3, 1e-4,  1e-5,  1e-6, 1e-7,
                                    1e-8, 1e-9, 1e-10, 1e-11, 1e-12};  ///< 1e-13 <= . <= 0.1
  std::vector<int> orders = {1, 2, 3, 4};                              ///< 1 to 4
  std::vector<int> grids = {25, 50, 100, 200, 400, 800};  ///< points of the rivals' grids, >= 5; may be empty
  int samples = 200;                                      ///< parameters at which errors are measured, >= 1
  int repeat = 5;                                         ///< runs whose median wall time counts, >= 1
};

/// Every violated inequality above, in words. Empty when the options can be used.
std::vector<std::string> find_faults(const StudyOptions& options);

/// Reference eigenvalues wherever the path passes one parameter value.
struct ReferenceSample {
  double p = 0.0;
  std::vector<std::vector<Complex>> passages;  ///< finite eigenvalues, one per complex pair, nearest doubles
};

struct ReferenceSet {
  std::vector<ReferenceSample> samples;  ///< those that could be solved, by ascending p
  int unsolved = 0;                      ///< parameter values without a reference
  double correction = 0.0;  ///< largest last correction, relative: what the references are good for
  double s_ref = 1.0;       ///< magnitude below which an eigenvalue counts as zero, 1/s
};

/// What produces eigenvalues.
enum class Method {
  trace,              ///< this program
  trace_uncertified,  ///< the same without certificate
  qz,                 ///< QZ on a grid, labels by modal assurance and optimal assignment
  zero_order,         ///< corrector on a grid, from the last point's modes
  secant,             ///< corrector on a grid, from the secant through the last two points
  tangent             ///< corrector on a grid, from the tangent at the last point
};

/// What a grid has between its points.
enum class Interpolation { linear, cubic_spline };

/// A method at one setting: what it achieved and what that took.
struct MeasuredRun {
  Method method = Method::trace;
  std::optional<Interpolation> interpolation;  ///< of grids
  double tolerance = 0.0;                      ///< not a number on grids
  int order = 0;                               ///< 0 on grids
  bool completed = false;                      ///< came to the end of the range
  std::string message;                         ///< why not
  int points = 0;                              ///< nodes or grid points
  double error = 0.0;                          ///< largest over all samples, as the tolerance counts it
  double worst_parameter = 0.0;                ///< where that is
  int measured = 0;                            ///< samples it could be measured at
  double seconds = 0.0;                        ///< median wall time
  std::uint64_t factorizations = 0;            ///< complex LU of about the pencil's size, all purposes
  std::uint64_t spectra = 0;                   ///< full spectra by QZ
  std::uint64_t evaluations = 0;               ///< of the model's effects, residuals and linearizations
  std::uint64_t bytes = 0;                     ///< of the loci file; 0 where there is none
};

/// "QZ", "corrector, secant".
std::string method_name(Method method);
/// "QZ, cubic spline".
std::string run_name(const MeasuredRun& run);

struct [[nodiscard]] Study {
  ReferenceSet reference;
  std::vector<MeasuredRun> runs;  ///< traces, then grids: with straight lines, with the spline
};

/// Parameters from a golden-ratio sequence within the range of the options, ascending.
std::vector<double> sample_parameters(const TraceOptions& options, int count);

/// References at the parameters, on the path that a trace with tolerance 1e-10 finds. Throws InputError when
/// the trace cannot be started.
ReferenceSet reference_set(const TraceSetup& setup, const std::vector<double>& parameters);

/// Traces the scene with the setup's options and measures.
MeasuredRun measure_trace(const TraceSetup& setup, const ReferenceSet& reference, int repeat);

/// The same grid with either interpolation; the time, that of its points, is the same.
struct GridRuns {
  MeasuredRun linear, spline;
};

/// Runs another method on an equidistant grid and measures, for the modes that a trace follows.
GridRuns measure_grid(const TraceSetup& setup, const ReferenceSet& reference, Method method, int points,
                      int repeat);

/// The whole study; `progress` is called with the number of runs done and of all runs.
Study accuracy_study(TraceSetup& setup, const StudyOptions& options,
                     const std::function<void(int, int)>& progress);

}  // namespace eigentrail
