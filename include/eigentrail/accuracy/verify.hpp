// Independent check of a loci file: the scene stored in it is solved afresh at random parameters, by QZ with
// the whole spectrum, and every dense-output value must find an eigenvalue of its own there.
#pragma once

#include <cstdint>
#include <string>

#include "eigentrail/store/loci_file.hpp"

namespace eigentrail {

struct VerifyOptions {
  int samples = 100;       ///< random parameters, >= 1
  std::uint64_t seed = 1;  ///< of their choice
};

/// The sample with the largest discrepancy.
struct Discrepancy {
  double relative = 0.0;  ///< |s_dense - s| / max(|s|, reference)
  double parameter = 0.0;
  int mode = -1;  ///< from 0; -1: none was found
};

struct [[nodiscard]] VerifyReport {
  int samples = 0;
  int unsolved = 0;  ///< samples without an equilibrium or a spectrum
  Discrepancy worst;
  double tolerance = 0.0;  ///< of the file

  /// Every sample was solved and no value is further off than the tolerance.
  bool passed() const { return unsolved == 0 && samples > 0 && worst.relative <= tolerance; }
};

/// Throws InputError when the file holds no points or its scene cannot be rebuilt.
VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options);

}  // namespace eigentrail
