// The stability map: how many modes grow, and how fast the least damped one decays, over a window of two
// parameters.
//
// Every line of the window, at one value of the second parameter, is one trace along the first. Its dense
// output and the stretches between its events (axis_stretches.hpp) give all cells of the line; no spectrum is
// computed in a cell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

struct MapOptions {
  std::string second;  ///< name of the second parameter
  double from = 0.0;   ///< first line, in the second parameter's unit
  double to = 1.0;     ///< last line, not equal to `from`
  int n_second = 50;   ///< lines, >= 2; n_second * n_first <= most_map_cells
  int n_first = 50;    ///< cells of a line, >= 2
  int jobs = 0;        ///< threads, >= 0, <= most_map_jobs; 0: one per core
};
inline constexpr long most_map_cells = 10'000'000;
inline constexpr int most_map_jobs = 1024;

/// A place on a line where an eigenvalue meets the imaginary axis.
struct AxisPoint {
  double p = 0.0;          ///< first parameter
  std::string kind;        ///< name of the event; "infinity" or "sign change"
  double frequency = 0.0;  ///< Im s, rad/s; NaN where the eigenvalue is infinite
};

/// One trace and its cells. `margin` has the sign that `unstable` says: cells within the error of a boundary
/// are decided by the located events, and their margin is zero where rounding has it otherwise.
struct MapLine {
  static constexpr int unknown = -1;

  double second = 0.0;                ///< value of the second parameter
  std::vector<int> unstable;          ///< per cell: modes that grow, or `unknown`
  std::vector<double> margin;         ///< per cell: -max Re s, 1/s; zero: marginal; NaN: unknown
  std::vector<double> damping_ratio;  ///< per cell: least -Re s/|s| of the complex pairs; NaN: none, unknown
  int marginal_cells = 0;             ///< no mode grows, some stay on the imaginary axis
  int doubtful_cells = 0;             ///< unknown although the trace came by: it had lost a mode there
  std::vector<AxisPoint> axis_points;
  TraceStatus status = TraceStatus::completed;
  std::string message;             ///< reason when not completed
  double reached = 0.0;            ///< last value of the first parameter; NaN when there was no start
  bool turned_back = false;        ///< the path folds: cells show its first passage
  int n_modes = 0;                 ///< followed at the start
  int n_available = 0;             ///< finite modes at the start
  Eigen::Index n_independent = 0;  ///< size of the reduced pencil
  RunCounts counts;

  std::uint64_t factorizations() const;  ///< complex LU of modes, certificate and special points
};

struct StabilityMap {
  std::vector<double> first;   ///< values of the first parameter, as the traces go
  std::vector<MapLine> lines;  ///< in the order of `from` to `to`
};

/// Cells by kind, and work.
struct MapTotals {
  std::size_t cells = 0, stable = 0, marginal = 0, unstable = 0, unknown = 0;
  std::uint64_t factorizations = 0;  ///< complex LU
  std::uint64_t spectra = 0;         ///< QZ
};
MapTotals total(const StabilityMap& map);

/// A scene that is ready to be mapped: the trace along the first parameter, and the window.
struct MapSetup {
  TraceSetup trace;
  MapOptions options;
};

/// Reads the trace's options with `overrides`, checks those of the map and builds the model, whose masses and
/// lengths are checked all over the window. Throws InputError for every fault.
MapSetup prepare_map(Scene scene, const OptionTexts& overrides, const MapOptions& options);

/// One line: the trace at a value of the second parameter, evaluated at the values `first` of the first one.
MapLine map_line(const MapSetup& setup, double second, const std::vector<double>& first);

/// All lines, several at a time. `done` is called after each with the number of lines that are finished, by
/// one thread at a time. The result does not depend on the number of threads. Exceptions of the model, the
/// trace or `done` pass after all threads have ended.
StabilityMap stability_map(
    const MapSetup& setup, const std::function<void(int)>& done = [](int) {});

}  // namespace eigentrail
