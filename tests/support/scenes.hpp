// Scenes for tests: from data/scenes or from texts, with parameters replaced.
#pragma once

#include <memory>
#include <string>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/model/build.hpp"

namespace eigentrail::test {

/// A model with what is needed to compute points on its path.
struct Setting : TraceSetup {
  /// Problem of the trace, with the scene's parameters.
  PathProblem problem() const;
  int parameter(const std::string& name) const;
};

/// Builds from a scene's text; `overrides` as on the command line.
Setting make_setting(const std::string& text, const OptionTexts& overrides = {});

/// Builds from data/scenes/<name>.toml after replacing texts in it: pairs of (what, with what). Every "what"
/// must occur, or std::invalid_argument is thrown: a stale replacement may not pass unnoticed.
Setting scene_setting(const std::string& name, const OptionTexts& overrides = {},
                      const std::vector<std::pair<std::string, std::string>>& replacements = {});

/// A point of the path with all modes, computed from the scene's own guess and the full spectrum; `order` of
/// the following differentiation.
PathPoint point_from_guess(const PathProblem& problem, double p, RunCounts& counts);

/// Every point of a trace.
struct RecordedTrace {
  TraceResult result;
  std::vector<PathNode> nodes;

  /// Dense output of all modes.
  ComplexVector eigenvalues_at(double p) const;
};
RecordedTrace record_trace(const Setting& setting, BasisChoice basis = BasisChoice::aligned);

}  // namespace eigentrail::test
