// Scenes for tests: from data/scenes or from texts, with parameters replaced.
#pragma once

#include <memory>
#include <string>

#include "eigentrail/continuation/path_point.hpp"
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
/// must occur; otherwise std::invalid_argument is thrown, so that outdated replacements are detected.
Setting scene_setting(const std::string& name, const OptionTexts& overrides = {},
                      const std::vector<std::pair<std::string, std::string>>& replacements = {});

/// A pendulum in the plane y = 0, pushed along its circle with p times its weight: sin(angle) = p, a fold at
/// p = 1 where it stands level. x = length p, z = -length cos(angle), s^2 = -g cos(angle) / length.
struct PushedPendulum {
  double mass = 1.0, length = 1.0;
  double unit = 1.0;  ///< unit of p
  double from = 0.0, to = 1.2;
  double guess = 0.0;  ///< x of the guess, whose z is -length
};
Setting pushed_pendulum(const PushedPendulum& pendulum, const OptionTexts& overrides = {});

/// The equilibrium from the scene's guess where parameters have these values, the others those of the scene.
Equilibrium at_rest(const Setting& setting, const std::vector<std::pair<std::string, double>>& values = {});

/// A point of the path with all modes, computed from the scene's own guess and the full spectrum; `order` of
/// the following differentiation.
PathPoint point_from_guess(const PathProblem& problem, double p, RunCounts& counts);

/// Every point and step of a trace.
struct RecordedTrace {
  TraceResult result;
  std::vector<PathNode> nodes;
  std::vector<std::vector<ModeState>> modes;  ///< per node
  std::vector<PathStep> steps;

  /// Dense output of all modes where the trace first passes p; NaN where a mode does not exist.
  ComplexVector eigenvalues_at(double p) const;
  /// The same wherever it passes p.
  std::vector<ComplexVector> all_eigenvalues_at(double p) const;
  /// Eigenvalues of all modes at a node.
  ComplexVector eigenvalues_of_node(std::size_t node) const;
};
RecordedTrace record_trace(const Setting& setting, BasisChoice basis = BasisChoice::aligned);
/// The same of a trace that has to arrive. Throws std::runtime_error with its message if it does not.
RecordedTrace completed_trace(const Setting& setting);

/// The events of one kind, and their places, by ascending parameter.
std::vector<Event> events_of(const TraceResult& result, EventKind kind);
std::vector<double> places_of(const TraceResult& result, EventKind kind);
/// The one event of a kind. Throws std::runtime_error if there is none or another one.
Event only_event(const TraceResult& result, EventKind kind);

}  // namespace eigentrail::test
