// The comparisons that `verify` makes, and what all of them need. Each is independent of the others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/texts.hpp"
#include "eigentrail/accuracy/verify.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "projection/large_spectrum.hpp"

namespace eigentrail {

/// Whether the stiffness is singular at events of a kind, and the path may turn.
inline bool is_static(EventKind kind) {
  return kind == EventKind::fold || kind == EventKind::branch_point || kind == EventKind::cusp;
}

/// A loci file that is checked, and what all comparisons need of it.
struct CheckedFile {
  const LociFile& loci;
  const TraceSetup& setup;
  EigenvalueAccuracy accuracy;  ///< of the trace
  std::vector<Event> events;    ///< of the file, with what is compared

  bool has_steps() const { return !loci.steps.empty(); }
  double scale_of(Complex s) const { return std::max(std::abs(s), accuracy.reference); }
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

/// The file with the matrices of a scene, or the first table of a rotor, as the scene names it; empty if they
/// stand in the scene.
std::string file_of_matrices(const Scene& scene);

/// The scene and the options of the trace in the file. Matrices in a file of their own are read again. Throws
/// InputError if the stored text does not give the model of the stored points.
TraceSetup setup_of(const LociFile& loci);

/// Solves the scene of a loci file at places of its path, from the stored equilibria: as a whole, or beside
/// the followed modes if the model is large. The setup and the file must outlive it.
class FreshSolver {
 public:
  FreshSolver(const TraceSetup& setup, const LociFile& loci);

  bool is_of_large_model() const { return large_.has_value(); }

  /// Equilibrium and reduced pencil at a place; not of a large model. A stored equilibrium is the guess only,
  /// because it is checked as well.
  PathPoint point_at(const PathPosition& position) const;

  /// Exact eigenvalues at a place where the file has the values s; empty if they cannot be computed.
  std::vector<Complex> spectrum_at(const PathPosition& position, const ComplexVector& s);

  /// The same refined, in extended precision or, where that cannot be had, by Newton's method: where
  /// eigenvalues are close, or the entries of the matrices of very different size, QZ itself is off by more
  /// than a trace. With `s` only the eigenvalues beside these are refined. Empty of a large model.
  std::vector<Complex> refined_spectrum_at(const PathPosition& position,
                                           const std::optional<ComplexVector>& s = {}) const;

 private:
  EquilibriumGuess guess_at(const PathPosition& position) const;
  bool path_may_turn_at(const PathPosition& position) const;

  PathProblem problem_;
  const LociFile& loci_;
  std::optional<LargeSpectrum> large_;
};

/// Number of random values, and largest number of stored points that are solved.
std::size_t samples_of(const VerifyOptions& options, const FreshSolver& solver);

/// Eigenvalues at random values of the parameter and at stored points, and at special points, against the
/// spectrum. Changed matrices are told from a wrong file where the stored points are off as well.
Comparison compare_spectra(const CheckedFile& file, const VerifyOptions& options, FreshSolver& solver);

/// The stored equilibria and mode shapes against their equations; not of a large model.
Comparison compare_points(const CheckedFile& file, const VerifyOptions& options, const FreshSolver& solver);

/// The ends of the dense output of each mode against its stored eigenvalues, and both ends of blocks against
/// each other: a label that is exchanged at some point, or between two, is found.
Comparison compare_labels(const CheckedFile& file);

/// Columns that follow from the eigenvalues.
Comparison compare_columns(const CheckedFile& file);

/// Each special point against the spectrum and its own condition.
Comparison compare_events(const CheckedFile& file, FreshSolver& solver);

/// Changes between stored points of the number of growing eigenvalues and of real ones against the special
/// points between them, and the stable ranges against points, special points and the spectrum in their
/// middle.
Comparison compare_stability(const CheckedFile& file, const FreshSolver& solver);

/// Everything against a new trace of the stored scene. Where its arithmetic is the same as in the file, as on
/// the same machine, all numbers must be the same bit for bit; elsewhere labels, special points and ranges.
Comparison compare_new_trace(const CheckedFile& file);

}  // namespace eigentrail
