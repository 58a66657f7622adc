// Reads a loci file: stored points, dense output, provenance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// A line of the `events` dataset.
struct LociEvent {
  std::string kind;
  double parameter = 0.0;
  Complex s;
  std::string modes;        ///< numbers from 1, separated by ';'
  double half_width = 0.0;  ///< veering; NaN otherwise
  Complex puiseux;          ///< collision of two; NaN otherwise
};

/// Contents of a loci file that `eval`, `events` and `info` need; read once, plain data.
struct LociFile {
  std::string path;
  std::string parameter;       ///< name of the traced parameter
  std::string parameter_unit;  ///< "1" when it has none
  std::vector<std::string> modes;
  std::vector<std::string> coordinates, constraints;
  std::vector<double> p;        ///< per node; monotonic unless the path turns back at a fold
  ComplexMatrix eigenvalues;    ///< node x mode, NaN where a mode does not exist
  std::vector<PathStep> steps;  ///< between neighbouring nodes
  std::vector<LociEvent> events;
  std::vector<double> residual, condition;        ///< node x mode, row-major
  Matrix equilibrium;                             ///< node x coordinate
  Matrix multiplier;                              ///< node x constraint
  std::map<std::string, std::string> attributes;  ///< root attributes as text

  std::size_t n_nodes() const { return p.size(); }
  double lowest() const;   ///< of the traced range; not a number when the file holds no points
  double highest() const;  ///< likewise

  /// A root attribute; throws InputError when the file lacks it.
  const std::string& attribute(const std::string& name) const;

  /// The stored point nearest to a parameter value; the file must hold points.
  std::size_t nearest_node(double parameter_value) const;

  /// A place on the path: t in [0, 1] on the step between two nodes.
  struct Position {
    std::size_t step = 0;
    double t = 0.0;
  };
  /// Where the path passes a parameter value, in the order of the trace; more than once behind a fold.
  std::vector<Position> positions(double parameter_value) const;

  /// Eigenvalues of all modes at a place; NaN where a mode does not exist. A complex pair is reported by its
  /// member with Im s >= 0.
  ComplexVector eigenvalues_at(const Position& position) const;

  /// Eigenvalues of all modes wherever the path passes a parameter value, at least once. Throws InputError
  /// outside the range.
  std::vector<ComplexVector> eigenvalues_at(double parameter_value) const;

  /// Share of the step covered modes whose identity is certified, of each mode; NaN where it never exists.
  double certified_share(std::size_t mode) const;
};

/// Throws InputError when the file is missing, no loci file, of a newer schema or inconsistent.
LociFile read_loci(const std::string& path);

}  // namespace eigentrail
