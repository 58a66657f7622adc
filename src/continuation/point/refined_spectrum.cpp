#include "continuation/point/refined_spectrum.hpp"

#include <limits>

#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/continuation/thresholds.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {

std::vector<double> refine(const ReducedPencil& pencil, int n, Spectrum& spectrum) {
  const double s_ref = share_that_is_zero * spectrum.scale;
  std::vector<double> rounding(static_cast<std::size_t>(n), std::numeric_limits<double>::infinity());
  ModeCounts counts;
  for (const StartingGroup& group : starting_groups(pencil, spectrum.modes, n, s_ref)) {
    const InvariantPair pair = correct_pair(PencilAtPoint(pencil.of(group.pair.part)), group.pair, s_ref,
                                            CorrectorOptions(), counts);
    if (pair.status != PairStatus::converged) continue;
    const ComplexVector roots = in_order_of(group.roots, pair_eigenvalues(pair));
    const Vector errors = eigenvalue_rounding(pair, roots, Thresholds().rounding.entries);
    for (Eigen::Index i = 0; i < roots.size(); ++i) {
      const int mode = group.modes[static_cast<std::size_t>(i)];
      if (mode < 0) continue;
      spectrum.modes[static_cast<std::size_t>(mode)].s =
          roots[i].imag() < 0.0 ? std::conj(roots[i]) : roots[i];
      rounding[static_cast<std::size_t>(mode)] = errors[i];
    }
  }
  // A mode of a copy is behind the one that it equals.
  for (std::size_t i = 1; i < rounding.size(); ++i) {
    if (spectrum.modes[i].copy == 0) continue;
    spectrum.modes[i].s = spectrum.modes[i - 1].s;
    rounding[i] = rounding[i - 1];
  }
  return rounding;
}

}  // namespace eigentrail
