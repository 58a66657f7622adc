// The stability map: the number of growing modes and the decay rate of the least damped one, on a grid over a
// window of two parameters.
//
// Each value of the second parameter gives one line of cells, which is computed by one trace along the first
// parameter. The cells are evaluated from the dense output of the trace and its stretches between events
// (axis_stretches.hpp). No spectrum is computed for a cell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigentrail/core/workers.hpp"
#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

struct MapOptions {
  std::string second;  ///< name of the second parameter
  double from = 0.0;   ///< second parameter of the first line, in its unit
  double to = 1.0;     ///< second parameter of the last line; not equal to `from`
  int n_second = 50;   ///< lines, >= 2; n_second * n_first <= most_map_cells
  int n_first = 50;    ///< cells of a line, >= 2
  int jobs = 0;        ///< threads, >= 0, <= most_map_jobs; 0: one per core
};
inline constexpr long most_map_cells = 10'000'000;
inline constexpr int most_map_jobs = 1024;

/// A place on a line where an eigenvalue meets the imaginary axis.
struct AxisPoint {
  double p = 0.0;          ///< value of the first parameter
  std::string kind;        ///< name of the event, or "infinity" or "sign change" where there is no event
  double frequency = 0.0;  ///< Im s, rad/s; NaN where the eigenvalue is infinite
};

/// One trace and its cells. The sign of `margin` agrees with `unstable`. In cells so close to a boundary that
/// the error of Re s matters, the located events decide the stability; where the computed -max Re s has the
/// other sign, the margin is set to zero.
struct MapLine {
  static constexpr int unknown = -1;

  double second = 0.0;                ///< value of the second parameter
  std::vector<int> unstable;          ///< per cell: number of growing modes, or `unknown`
  std::vector<double> margin;         ///< per cell: -max Re s, 1/s; zero: marginal; NaN: unknown
  std::vector<double> damping_ratio;  ///< per cell: least -Re s/|s| of the complex pairs; NaN: none, unknown
  int marginal_cells = 0;             ///< number of cells where no mode grows and some are on the axis
  int doubtful_cells = 0;             ///< number of unknown cells on steps where the trace lacks a mode
  int partial_cells = 0;  ///< number of cells where no followed mode grows and others are not known
  std::vector<AxisPoint> axis_points;
  TraceStatus status = TraceStatus::completed;
  std::string message;             ///< reason when not completed
  double reached = 0.0;            ///< last value of the first parameter; NaN if the trace did not start
  bool turned_back = false;        ///< the path folds; a cell shows the first passage of the path
  int n_modes = 0;                 ///< followed at the start
  int n_available = 0;             ///< finite modes at the start
  Eigen::Index n_independent = 0;  ///< size of the reduced pencil
  RunCounts counts;

  std::uint64_t factorizations() const;  ///< complex LU of modes, certificate and special points
};

struct StabilityMap {
  std::vector<double> first;   ///< values of the first parameter, in the direction of the traces
  std::vector<MapLine> lines;  ///< in the order of `from` to `to`
};

/// Numbers of cells of each kind, and work of all lines.
struct MapTotals {
  std::size_t cells = 0, stable = 0, marginal = 0, unstable = 0, unknown = 0;
  std::uint64_t factorizations = 0;  ///< complex LU
  std::uint64_t spectra = 0;         ///< QZ
};
MapTotals total(const StabilityMap& map);

/// Sentences for the user on lines that are incomplete: for each kind the number of lines and the first one.
/// `second`: name of the second parameter.
std::vector<std::string> notes_on(const StabilityMap& map, const std::string& second);

/// A scene with its model and checked options: the trace along the first parameter, and the window.
struct MapSetup {
  TraceSetup trace;
  MapOptions options;
};

/// Reads the options of the trace with `overrides`, checks those of the map, and builds the model. Masses and
/// lengths are checked at points all over the window. Throws InputError if anything is not valid.
MapSetup prepare_map(Scene scene, const OptionTexts& overrides, const MapOptions& options);

/// The same without the model: enough to write a map whose lines have been computed.
MapSetup read_map_setup(Scene scene, const OptionTexts& overrides, const MapOptions& options);

/// One line: traces the first parameter at a value of the second one, and evaluates the cells at the values
/// `first` of the first parameter.
MapLine map_line(const MapSetup& setup, double second, const std::vector<double>& first);

/// The lines with these numbers, counted from 0 in the order of `from` to `to`, each as bytes that do not
/// depend on who computes it. `finished` as in Workers::compute.
std::vector<std::string> map_lines(
    const MapSetup& setup, const std::vector<std::size_t>& numbers, Workers& workers,
    const std::function<void(std::size_t)>& finished = [](std::size_t) {});

/// The map of all lines, in order. Throws InputError if a line is not what map_lines makes.
StabilityMap map_of(const MapSetup& setup, const std::vector<std::string>& lines);

/// All lines, several in parallel. After each line `done` is called with the number of finished lines; calls
/// do not overlap. The result does not depend on the number of threads. An exception of the model, the trace
/// or `done` is rethrown after all threads have ended.
StabilityMap stability_map(
    const MapSetup& setup, const std::function<void(int)>& done = [](int) {});

}  // namespace eigentrail
