// Checks that no mode is lost and none is followed by two tracks, and recognition of a mode from another
// point.
#pragma once

#include <optional>

#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

/// Checksum for a trace that follows every finite mode: sum s = -tr(M^-1 C), sum s^2 = tr((M^-1 C)^2) - 2
/// tr(M^-1 K), and the same for the sums of 1/s and 1/s^2, with M and K exchanged. If K is nearly singular,
/// as with rigid-body modes, these are the sums of 1 / (s - shift). The sums of s are sensitive to high
/// modes, those of 1/s to low ones. Infinite eigenvalues count zero in the latter; the former are left out if
/// M is nearly singular. Detects lost and doubled modes, but not exchanged ones. Cost O(n^3) in real
/// arithmetic.
bool checksum_holds(const PathNode& node, const PathProblem& problem);

/// The modes of a full spectrum that no track follows. Tracks and modes are assigned to each other one to
/// one. `s_ref`: magnitude below which an eigenvalue counts as zero, 1/s.
std::vector<StartingMode> missing_modes(const PathNode& node, const Spectrum& spectrum, double s_ref,
                                        const RoundingThresholds& thresholds);

/// Whether two tracks at a point have an eigenpair in common: eigenvalues that differ by at most
/// `merged_distance`, relative to their size or to `reference`, and a vector of one that has at least the
/// assurance `merged_assurance` with the space of the other. `rounding`: of the eigenvalues of `a`, if they
/// count as the same within it.
bool have_common_eigenpair(const Track& a, const Track& b, double reference,
                           const IdentityThresholds& thresholds, const Vector& rounding = {});

/// Whether a track of the node has an eigenpair in common with this one.
bool is_followed(const PathProblem& problem, const PathNode& node, const Track& track);

/// The track at `node` that a pair leads to. `start`: the pair elsewhere, or as predicted here, Z in physical
/// coordinates. Empty where the corrector does not converge, the shape becomes another one, or another track
/// has the eigenpair. The numbers of its modes are not set.
std::optional<Track> recognize(const PathProblem& problem, const PathNode& node, InvariantPair start,
                               RunCounts& counts);

/// Which eigenvalues end. No result depends on the exact values.
struct InfinityThresholds {
  /// As a share of the magnitude that counts as infinite: from here on such an eigenvalue ends. A larger
  /// value follows it farther, at the cost of short steps.
  double leaves = 0.01;
  /// As a share of the same: up to here one that came from infinity is added to the modes. With a larger
  /// value it is added sooner, and its first steps are shorter.
  double arrived = 0.005;
  /// Largest |mu mu'' / mu'^2 + 1| of mu = 1/s that vanishes like a square root, for which it is zero; it is
  /// one where mu passes zero smoothly. The same for |Im| / |Re| of the distance of that place.
  double like_a_root = 0.2;
};

/// Whether an eigenvalue that nobody follows may be taken: it is not so large that it has just come from
/// infinity (InfinityThresholds::arrived), or the mass is regular and no eigenvalue is infinite nearby.
bool has_arrived(const PathProblem& problem, const PathNode& node, Complex s,
                 const InfinityThresholds& thresholds = {});

/// Whether the backward error of a track is so large that it is no eigenpair, or two tracks have the same
/// eigenpair (have_common_eigenpair). Cost O(n) for every two tracks with such eigenvalues.
bool has_doubtful_track(const PathNode& node, const PathProblem& problem);

/// A mode that went on as the conjugate of another one, and ended.
struct OnePair {
  int kept = 0, ended = 0;  ///< numbers of the modes
};

/// The result of `complete`.
struct Completion {
  std::vector<OnePair> pairs = {};  ///< modes that are one complex pair now
  bool doubtful = false;            ///< as has_doubtful_track
  int added = 0;                    ///< modes that were missing
};

/// Checks that no mode is lost or followed twice at a point. Of two tracks that are conjugates of each other,
/// the later one ends: two real eigenvalues that passed infinity are one complex pair behind it. Where all
/// modes are followed (`follows_all`) and the checksum does not hold, computes a full spectrum and adds the
/// missing modes to the node, with new numbers. At a point where eigenvalues coincide nothing is checked,
/// since they are known to the square root of rounding only. Cost: that of the checksum, and if it fails of a
/// spectrum, O(n^3) each.
Completion complete(const PathProblem& problem, bool follows_all, PathNode& node, ModeNumbers& numbers,
                    RunCounts& counts);

}  // namespace eigentrail
