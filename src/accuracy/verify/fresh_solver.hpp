// Solves the scene of a loci file at places of its path, from the stored equilibria.
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "projection/large_spectrum.hpp"

namespace eigentrail {

/// Solves as a whole, or beside the followed modes if the model is large. The setup and the file must outlive
/// it.
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
  /// than a trace. Empty of a large model.
  std::vector<Complex> refined_spectrum_at(const PathPosition& position) const;

 private:
  EquilibriumGuess guess_at(const PathPosition& position) const;
  bool path_may_turn_at(const PathPosition& position) const;

  PathProblem problem_;
  const LociFile& loci_;
  std::optional<LargeSpectrum> large_;
};

}  // namespace eigentrail
