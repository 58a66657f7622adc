// Options of a search for stability boundaries in two parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct BoundaryOptions {
  TraceOptions
      trace;  ///< parameter, from, to: the first parameter and its range; tolerance; what is followed
  std::string second;        ///< name of the second parameter
  double second_from = 0.0;  ///< its range, in its unit; not empty
  double second_to = 0.0;
  std::optional<double> damping_ratio;  ///< follow {damping ratio = this} instead, -1 < . < 1, not 0
  int lines = 5;  ///< inner lines of the window that are searched in either direction, 0 <= . <= 1000
};

/// What the command line says; what is not given stands in the scene's [trace] table.
struct BoundaryRequest {
  std::string second;
  double from = 0.0, to = 0.0;  ///< of the second parameter
  std::optional<std::string> parameter;
  std::optional<double> first_from, first_to;
  std::optional<double> tolerance;
  std::optional<double> damping_ratio;
  std::optional<int> lines;
};

/// A scene whose stability boundaries can be looked for.
struct BoundarySetup {
  Scene scene;
  BoundaryOptions options;
  std::unique_ptr<Model> model;
};

/// Reads the options and builds the model. Throws InputError for every fault of either.
BoundarySetup prepare_boundary(Scene scene, const BoundaryRequest& request);

}  // namespace eigentrail
