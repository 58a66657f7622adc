// Reads a loci file: stored points, dense output, provenance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Contents of a loci file that `eval` and `info` need; read once, plain data.
struct LociFile {
  std::string path;
  std::string parameter;       ///< name of the traced parameter
  std::string parameter_unit;  ///< "1" when it has none
  std::vector<std::string> modes;
  std::vector<std::string> coordinates, constraints;
  std::vector<double> p;                          ///< per node, monotonic
  std::vector<ComplexMatrix> series;              ///< per node: modes x (order + 1)
  std::vector<double> residual, condition;        ///< node x mode, row-major
  Matrix equilibrium;                             ///< node x coordinate
  Matrix multiplier;                              ///< node x constraint
  std::map<std::string, std::string> attributes;  ///< root attributes as text

  std::size_t n_nodes() const { return p.size(); }
  double lowest() const;   ///< of the traced range; not a number when the file holds no points
  double highest() const;  ///< likewise

  /// The stored point nearest to a parameter value; the file must hold points.
  std::size_t nearest_node(double parameter_value) const;

  /// Eigenvalues of all modes at a parameter value within the traced range. A complex
  /// pair is reported by its member with Im s >= 0. Throws InputError outside the range.
  ComplexVector eigenvalues_at(double parameter_value) const;
};

/// Throws InputError when the file is missing, no loci file, of a newer schema or inconsistent.
LociFile read_loci(const std::string& path);

}  // namespace eigentrail
