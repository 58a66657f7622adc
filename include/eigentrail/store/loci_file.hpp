// Reads a loci file: stored points, dense output, provenance.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

/// An event in a loci file. `half_width` of other events than veerings and `puiseux` of others than
/// collisions are NaN.
struct LociEvent : EventFacts {
  std::string kind;
  double parameter = 0.0;
  Complex s;
  std::string modes;          ///< numbers of the modes from 1, separated by ';'
  int node = 0;               ///< this and what follows as in Event
  ComplexVector shape;        ///< per coordinate
  ComplexVector sensitivity;  ///< ds/dq per parameter q of the scene; NaN where not defined
  Vector shift;  ///< derivative of the event's `parameter` with respect to q; NaN where not defined
};

/// A trimmed parameter in a loci file.
struct TrimmedParameter {
  std::string name;
  std::string unit;            ///< "1" if it has none
  std::string about;           ///< its condition
  std::vector<double> values;  ///< per node
};

/// Contents of a loci file without eigenvalue derivatives and mode shapes.
struct LociFile : RecordedPath {
  std::string path;
  std::string parameter;                      ///< name of the traced parameter
  std::vector<std::string> scene_parameters;  ///< names of all parameters of the scene
  std::string parameter_unit;                 ///< unit of the traced parameter; "1" if it has none
  std::vector<std::string> modes;             ///< labels: "mode 1", ...
  std::vector<std::string> mode_names;        ///< descriptions such as "blade flap"; empty where unknown
  std::vector<std::string> coordinates, constraints;
  std::vector<LociEvent> events;
  /// Stable and marginal ranges; absent if the trace has not ended or the file was written by a version
  /// without them.
  std::optional<std::vector<StableRange>> ranges;
  /// Errors of the model's data; absent if it has none of its own, or the trace has not ended.
  std::optional<DataErrors> data_errors;
  std::vector<double> residual, condition;        ///< node x mode, row-major
  Matrix equilibrium;                             ///< node x coordinate
  Matrix multiplier;                              ///< node x constraint
  std::vector<TrimmedParameter> trimmed;          ///< their series are those of the steps
  std::map<std::string, std::string> attributes;  ///< root attributes as text

  /// A root attribute; throws InputError if the file lacks it.
  const std::string& attribute(const std::string& name) const;
  /// The number that a root attribute holds; throws InputError if it is none.
  double number(const std::string& name) const;

  using RecordedPath::eigenvalues_at;
  /// Eigenvalues of all modes at each place of the path with this parameter value; several if the path folds.
  /// Throws InputError outside the traced range.
  std::vector<ComplexVector> eigenvalues_at(double parameter_value) const;

  /// Fraction of the path length on which the mode exists and is certified, of that on which it exists; NaN
  /// if it exists on no step.
  double certified_share(std::size_t mode) const;

  /// The stretches of the path on which a mode exists and is not certified: first and last point of each.
  std::vector<std::pair<std::size_t, std::size_t>> uncertified(std::size_t mode) const;
};

/// Throws InputError unless `path` is a regular file that may be a result: no scene.
void require_result_file(const std::string& path);

/// Reads a loci file. Throws InputError if the file is missing, is no loci file, has another schema version
/// or is inconsistent.
LociFile read_loci(const std::string& path);

/// The same from the bytes of a file; `name` is used in messages.
LociFile read_loci_image(const std::string& name, std::string_view image);

/// Calls `use` with the mode shapes of every stored point: mode x coordinate, row-major, NaN where a mode
/// does not exist. Reads one point at a time. Throws InputError if the file does not fit `loci`, which was
/// read from it.
void read_mode_shapes(const LociFile& loci,
                      const std::function<void(std::size_t node, std::span<const Complex> shapes)>& use);

}  // namespace eigentrail
