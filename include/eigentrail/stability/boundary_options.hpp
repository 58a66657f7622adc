// Options of a search for stability boundaries in two parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct BoundaryOptions {
  TraceOptions
      trace;  ///< the first parameter and its range (parameter, from, to), tolerance, modes to follow
  std::string second;        ///< name of the second parameter
  double second_from = 0.0;  ///< range of the second parameter, in its unit; second_from < second_to
  double second_to = 0.0;
  /// Follow the curves on which a complex pair has this damping ratio instead of flutter and divergence;
  /// -1 < . < 1, not 0.
  std::optional<double> damping_ratio;
  int lines = 5;  ///< inner lines of the window that are searched in each direction, 0 <= . <= 1000
};

/// Options of the command line. Those that are not given are taken from the scene's [trace] and [events]
/// tables.
struct BoundaryRequest {
  std::string second;
  double from = 0.0, to = 0.0;  ///< range of the second parameter
  OptionTexts overrides = {};   ///< of [trace]: parameter, from, to, tolerance
  std::optional<double> damping_ratio = {};
  std::optional<int> lines = {};
};

/// A scene with checked options and its model, ready for find_boundaries.
struct BoundarySetup {
  Scene scene;
  BoundaryOptions options;
  std::unique_ptr<Model> model;
};

/// Reads the options and builds the model. Throws InputError if an option or the scene is not valid.
BoundarySetup prepare_boundary(Scene scene, const BoundaryRequest& request);

}  // namespace eigentrail
