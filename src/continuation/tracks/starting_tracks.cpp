#include "continuation/tracks/starting_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/connected_groups.hpp"
#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Double eigenvalues zero, rigid-body motions for example, are known only to the square root of rounding,
/// relative to the square root of |K|/|M|, or to |K|/|C| in equations of first order. This is ten times as
/// much, for the factors that depend on n.
constexpr double blurred = 1.5e-7;

/// Magnitude (1/s) up to which eigenvalues cannot be distinguished from zero.
double blur_at_zero(const ReducedPencil& pencil) {
  const double mass = pencil.M[0].norm(), damping = pencil.C[0].norm(), stiffness = pencil.K[0].norm();
  if (mass > 0.0) return blurred * std::sqrt(stiffness / mass);
  return damping > 0.0 ? blurred * stiffness / damping : 0.0;
}

/// Indices of modes that are connected by close eigenvalues; those of copies are by themselves. A mode is
/// also close to another if it is close to the conjugate of that. `s_ref`: magnitude below which eigenvalues
/// count as zero; `blur`: as from blur_at_zero.
Groups close_groups(const std::vector<StartingMode>& modes, double s_ref, double blur, double close) {
  return connected_groups(static_cast<Eigen::Index>(modes.size()), [&](Eigen::Index i, Eigen::Index j) {
    const StartingMode& one = modes[static_cast<std::size_t>(i)];
    const StartingMode& other = modes[static_cast<std::size_t>(j)];
    if (one.part != other.part || one.copy > 0 || other.copy > 0) return false;
    const double size = std::max(std::abs(one.s), std::abs(other.s));
    const double distance = std::min(std::abs(one.s - other.s), std::abs(one.s - std::conj(other.s)));
    return distance <= close * std::max(size, s_ref) || size <= blur;
  });
}

/// Whether an eigenvalue is so close to its conjugate that both start in one block.
bool near_real(Complex s, double s_ref, double close) {
  return 2.0 * std::abs(s.imag()) <= close * std::max(std::abs(s), s_ref);
}

}  // namespace

std::vector<StartingGroup> starting_groups(const ReducedPencil& pencil,
                                           const std::vector<StartingMode>& modes, int n_modes, double s_ref,
                                           double least_scale, double close) {
  s_ref = std::max(s_ref, least_scale);
  const double blur = blur_at_zero(pencil);
  std::vector<StartingGroup> groups;
  for (const std::vector<Eigen::Index>& members : close_groups(modes, s_ref, blur, close)) {
    const StartingMode& first = modes[static_cast<std::size_t>(members.front())];
    if (first.copy > 0 || members.front() >= n_modes) continue;
    const bool is_real = std::any_of(members.begin(), members.end(), [&](Eigen::Index i) {
      const Complex s = modes[static_cast<std::size_t>(i)].s;
      return near_real(s, s_ref, close) || std::abs(s) <= blur;
    });
    std::vector<Complex> roots;
    StartingGroup group;
    for (const Eigen::Index i : members) {
      const Complex value = modes[static_cast<std::size_t>(i)].s;
      const bool followed = i < n_modes;
      roots.push_back(value);
      group.modes.push_back(followed ? static_cast<int>(i) : Track::guard);
      if (!is_real || value.imag() == 0.0) continue;
      roots.push_back(std::conj(value));
      group.modes.push_back(followed ? Track::no_mode : Track::guard);
    }
    group.roots = Eigen::Map<ComplexVector>(roots.data(), static_cast<Eigen::Index>(roots.size()));
    const ReducedPencil& own = pencil.of(first.part);
    if (roots.size() == 1) {
      group.pair.is_real = roots[0].imag() == 0.0;
      group.pair.Z = first.z.size() > 0 ? first.z : eigenvector_near(own, first.s, s_ref);
      group.pair.Lambda = group.roots;
      if (group.pair.is_real) group.pair.Z.imag().setZero();
    } else {
      const Complex centre = is_real ? Complex(group.roots.mean().real()) : group.roots.mean();
      group.pair = invariant_subspace(own, centre, group.roots.size(), is_real, least_scale);
    }
    group.pair.part = first.part;
    groups.push_back(std::move(group));
  }
  return groups;
}

std::optional<Track> track_of(const PathProblem& problem, const PathNode& node, const StartingGroup& group,
                              RunCounts& counts) {
  const PencilAtPoint pencil(node.pencil.of(group.pair.part), group.pair.chart);
  InvariantPair pair =
      correct_pair(pencil, group.pair, problem.reference(group.pair.chart), problem.corrector, counts.modes);
  if (pair.status != PairStatus::converged) return std::nullopt;
  Track track = differentiate_track(problem, node, std::move(pair), counts);
  if (!track.functions.allFinite()) return std::nullopt;
  track.roots = in_order_of(group.roots, track.roots);
  track.modes = group.modes;
  return track;
}

}  // namespace eigentrail
