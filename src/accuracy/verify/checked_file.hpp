// A loci file that is checked, and what all comparisons need of it.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/accuracy/verify.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Whether the stiffness is singular at events of a kind, and the path may turn.
inline bool is_static(EventKind kind) {
  return kind == EventKind::fold || kind == EventKind::branch_point || kind == EventKind::cusp;
}

struct CheckedFile {
  const LociFile& loci;
  const TraceSetup& setup;
  EigenvalueAccuracy accuracy;  ///< of the trace
  std::vector<Event> events;    ///< of the file, without sensitivities

  bool has_steps() const { return !loci.steps.empty(); }
  double scale_of(Complex s) const { return std::max(std::abs(s), accuracy.reference); }
  /// The place of a stored point.
  PathPosition node(std::size_t number) const;
  /// Whether eigenvalues meet or the path turns at a stored point: each eigenvalue is known to a root of
  /// rounding only.
  bool is_meeting(std::size_t number) const;
  /// Up to `most` other stored points, evenly spread.
  std::vector<std::size_t> plain_nodes(std::size_t most) const;
  std::string at(double p) const;                          ///< "omega = 12.5"
  std::string mode_at(Eigen::Index mode, double p) const;  ///< "mode 2 at omega = 12.5"
};

/// Throws InputError if an event cannot be read.
CheckedFile checked_file(const LociFile& loci, const TraceSetup& setup);

/// "1 point", "3 points".
std::string count_text(std::size_t count, const std::string& what);

/// The file with the matrices of a scene, or the first table of a rotor, as the scene names it; empty if they
/// stand in the scene.
std::string file_of_matrices(const Scene& scene);

/// The scene and the options of the trace in the file. Matrices in a file of their own are read again. Throws
/// InputError if the stored text does not give the model of the stored points.
TraceSetup setup_of(const LociFile& loci);

}  // namespace eigentrail
