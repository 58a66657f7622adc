// Reads a loci file: stored points, dense output, provenance.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

/// A line of the `events` dataset.
struct LociEvent {
  std::string kind;
  double parameter = 0.0;
  Complex s;
  std::string modes;        ///< numbers from 1, separated by ';'
  double half_width = 0.0;  ///< veering; NaN otherwise
  Complex puiseux;          ///< collision of two; NaN otherwise
  int direction = 0;        ///< as in Event, and the following
  double value = 0.0;
  ComplexVector shape;        ///< per coordinate
  ComplexVector sensitivity;  ///< per parameter of the scene, NaN where not defined
  Vector shift;
};

/// Contents of a loci file that `eval`, `events` and `info` need; read once, plain data.
struct LociFile : RecordedPath {
  std::string path;
  std::string parameter;                      ///< name of the traced parameter
  std::vector<std::string> scene_parameters;  ///< names of all
  std::string parameter_unit;                 ///< "1" when it has none
  std::vector<std::string> modes;
  std::vector<std::string> mode_names;  ///< what moves in each mode; empty where nothing is known
  std::vector<std::string> coordinates, constraints;
  std::vector<LociEvent> events;
  /// Stable and marginal ranges; absent in a file whose trace did not come to its end, or came before them.
  std::optional<std::vector<StableRange>> ranges;
  std::vector<double> residual, condition;        ///< node x mode, row-major
  Matrix equilibrium;                             ///< node x coordinate
  Matrix multiplier;                              ///< node x constraint
  std::map<std::string, std::string> attributes;  ///< root attributes as text

  /// A root attribute; throws InputError when the file lacks it.
  const std::string& attribute(const std::string& name) const;

  /// The stored point nearest to a parameter value; the file must hold points.
  std::size_t nearest_node(double parameter_value) const;

  using RecordedPath::eigenvalues_at;
  /// Eigenvalues of all modes wherever the path passes a parameter value, at least once. Throws InputError
  /// outside the range.
  std::vector<ComplexVector> eigenvalues_at(double parameter_value) const;

  /// Share of the step covered modes whose identity is certified, of each mode; NaN where it never exists.
  double certified_share(std::size_t mode) const;
};

/// Throws InputError when the file is missing, no loci file, of a newer schema or inconsistent.
LociFile read_loci(const std::string& path);

}  // namespace eigentrail
