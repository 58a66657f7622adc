// Independent check of a loci file. At random parameter values the stored scene is solved again and its
// whole spectrum is computed by QZ. Each value of the dense output is compared with the eigenvalue assigned
// to it, one to one. Where one is off, the spectrum is refined in extended precision before it is judged: of
// close eigenvalues, and where entries differ by orders of magnitude, QZ has larger errors than a trace. Of a
// large model, which was projected for the trace, the whole model is solved by shift-invert iterations for
// the eigenvalues nearest to the followed ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "eigentrail/store/loci_file.hpp"

namespace eigentrail {

struct VerifyOptions {
  /// Number of random parameter values, >= 1; absent: 100, of a large model 10, with a factorization each.
  std::optional<int> samples = {};
  std::uint64_t seed = 1;  ///< of the random numbers
};

/// The sample with the largest discrepancy.
struct Discrepancy {
  /// |s_dense - s| / max(|s|, reference). For eigenvalues that are followed as a block, this divided by the
  /// bound of their error in units of the tolerance: beside an exceptional point a small error of the block
  /// moves its eigenvalues by the root of it.
  double relative = 0.0;
  double parameter = 0.0;
  int mode = -1;  ///< from 0; -1: no sample was solved
};

struct [[nodiscard]] VerifyReport {
  bool large = false;  ///< the model was projected for the trace, and is solved as a whole here
  int samples = 0;
  int unsolved = 0;  ///< number of places without an equilibrium or a spectrum
  int refined = 0;   ///< number of places that were solved in extended precision as well
  Discrepancy worst;
  int missing = 0;          ///< largest number of eigenvalues that no mode has, where all modes are followed
  double missing_at = 0.0;  ///< the parameter there
  double tolerance = 0.0;   ///< of the file
  /// The file with the model's matrices, if the check failed and already the stored points do not fit them.
  std::string other_matrices;

  /// Every sample was solved, no value is further off than the tolerance, and no eigenvalue is missing.
  bool passed() const { return unsolved == 0 && samples > 0 && worst.relative <= tolerance && missing == 0; }
};

/// Checks a loci file. Throws InputError if the file contains no points or its scene cannot be rebuilt.
VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options);

}  // namespace eigentrail
