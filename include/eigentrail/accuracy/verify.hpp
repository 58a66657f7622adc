// Independent check of a loci file: what it says is computed again and compared.
//
//   spectra         at random parameter values and at the stored points the stored scene is solved again, and
//                   its spectrum is computed by QZ. Each eigenvalue of the file is compared with the one
//                   assigned to it, one to one. Where one is off, the spectrum is refined in extended
//                   precision before it is judged: of close eigenvalues, and where entries differ by orders
//                   of magnitude, QZ has larger errors than a trace. Of a large model, which was projected
//                   for the trace, the whole model is solved by shift-invert iterations for the eigenvalues
//                   nearest to the followed ones.
//   points          the stored equilibria and mode shapes fulfil their equations
//   labels          the dense output of each mode goes from its stored eigenvalue to the next one
//   special points  each one has its eigenvalue in the spectrum there, and fulfils its condition; changes of
//                   the number of growing eigenvalues and of real ones have their special points
//   ranges          follow from the points, the dense output and the special points
//   all of it       a new trace of the stored scene gives the same numbers
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/store/loci_file.hpp"

namespace eigentrail {

struct VerifyOptions {
  /// Number of random parameter values, and largest number of stored points that are solved, >= 1; absent:
  /// 100, of a large model 10, with a factorization each.
  std::optional<int> samples = {};
  std::uint64_t seed = 1;  ///< of the random numbers
};

/// One of the comparisons above.
struct Comparison {
  std::string compared;             ///< what was compared, in words
  std::vector<std::string> faults;  ///< what is wrong, and where
};

struct [[nodiscard]] VerifyReport {
  std::vector<Comparison> comparisons;

  bool passed() const;
};

/// Checks a loci file. Throws InputError if the file contains no points or its scene cannot be rebuilt.
VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options);

}  // namespace eigentrail
