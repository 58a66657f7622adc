#include <algorithm>
#include <cmath>

#include "continuation/completeness.hpp"
#include "continuation/starting_tracks.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

constexpr std::size_t most_notes = 20;

}  // namespace

/// Checks that no mode is lost or followed twice, and adds what is missing at the point where all are
/// followed.
void Tracer::complete(PathNode& node) {
  const StageTimer timer(result_.counts.matching_seconds);
  // Where eigenvalues meet they are known to half their digits; the next point is looked at again.
  const bool meeting = std::any_of(node.tracks.begin(), node.tracks.end(),
                                   [](const Track& track) { return track.departure.has_value(); });
  if (meeting) return;
  if (has_doubtful_track(node, problem_) && result_.notes.size() < most_notes) {
    result_.notes.push_back("at " + at_parameter(node.p) +
                            " two tracks share an eigenvalue, or one has left the spectrum; see verify");
  }
  if (!follows_all_ || checksum_holds(node, problem_)) return;
  const Spectrum spectrum = compute_spectrum(node.pencil.M[0], node.pencil.C[0], node.pencil.K[0]);
  ++result_.counts.spectra;
  if (spectrum.status != SpectrumStatus::complete) return;
  std::vector<StartingMode> missing = missing_modes(node, spectrum, problem_.s_ref);
  // Eigenvalues on their way in from infinity are added when they have arrived.
  std::erase_if(missing, [&](const StartingMode& mode) { return std::abs(mode.s) > 0.1 * problem_.s_max; });
  const auto groups = starting_groups(node.pencil, missing, static_cast<int>(missing.size()), problem_.s_ref);
  for (const StartingGroup& group : groups) {
    InvariantPair pair = correct_pair(PencilAtPoint(node.pencil), group.pair, problem_.s_ref,
                                      problem_.corrector, result_.counts.modes);
    if (pair.status != PairStatus::converged) continue;
    Track track = differentiate_track(problem_, node, std::move(pair), result_.counts);
    track.roots = in_order_of(group.roots, track.roots);
    track.modes.clear();
    for (const int mode : group.modes) track.modes.push_back(mode >= 0 ? result_.n_columns++ : mode);
    track.arriving = track.modes;
    node.tracks.push_back(std::move(track));
    ++result_.regroupings.repaired;
    result_.notes.push_back("a mode that was missing was added at " + at_parameter(node.p));
  }
}

}  // namespace eigentrail
