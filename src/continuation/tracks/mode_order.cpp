#include "continuation/tracks/mode_order.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/step/shared_basis.hpp"
#include "continuation/tracks/eigenvalue_branches.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// In steps: distance from a point with coinciding eigenvalues at which these are distinguished. Close to an
/// exceptional point they differ there by sqrt(1e-5) of their difference over the step, far above the square
/// root of rounding.
constexpr double beside_meeting = 1e-5;
/// As a share of the first step: the same at a branch point, where the eigenvalues of the other path vary on
/// the scale of the first step, which is short.
constexpr double beside_branch_point = 1e-3;

/// Eigenvalues of a track at a distance from its point, by its series.
ComplexVector roots_beside(const Track& track, double distance) {
  return block_roots(evaluate_series(track.functions, distance));
}

/// Forgets with which mode another one was a pair: it has become one with an eigenvalue that nobody follows,
/// and the former partner may go on elsewhere.
void forget_partner(int mode, ModeNumbers& numbers) {
  const auto found = numbers.partners.find(mode);
  if (found == numbers.partners.end()) return;
  const auto back = numbers.partners.find(found->second);
  if (back != numbers.partners.end() && back->second == mode) numbers.partners.erase(back);
  numbers.partners.erase(mode);
}

/// Assigns the mode of every complex pair of a real block to the member with Im s > 0, in either chart. Two
/// modes that have become a pair keep the smaller number and are noted as partners.
void settle_pairs(Track& track, ComplexVector& roots, ModeNumbers& numbers) {
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    if (roots[i].imag() == 0.0) continue;
    const Eigen::Index j = conjugate_of(roots, i);
    if (j <= i) continue;
    int& a = track.modes[static_cast<std::size_t>(i)];
    int& b = track.modes[static_cast<std::size_t>(j)];
    const bool followed = a >= 0 || b >= 0;
    const int upper = a >= 0 && b >= 0 ? std::min(a, b) : std::max(a, b);
    if (a >= 0 && b >= 0) {
      numbers.partners[a] = b;
      numbers.partners[b] = a;
    } else if (followed && std::min(a, b) == Track::guard) {
      forget_partner(upper, numbers);
    }
    a = upper;
    b = followed ? Track::no_mode : Track::guard;
    if (is_lower(roots[i], track.pair.chart)) std::swap(a, b);
  }
}

/// The mode from which a new real mode comes: the nearest real one in the block whose partner is not in the
/// block.
int parent_of(const Track& track, const ComplexVector& roots, Eigen::Index root, const ModeNumbers& numbers) {
  int parent = 0;
  double nearest = INFINITY;
  for (Eigen::Index j = 0; j < roots.size(); ++j) {
    const int other = track.modes[static_cast<std::size_t>(j)];
    if (j == root || other < 0 || roots[j].imag() != 0.0) continue;
    const double distance = std::abs(roots[j] - roots[root]);
    const auto known = numbers.partners.find(other);
    const bool taken = known != numbers.partners.end() && contains(track.modes, known->second);
    if (taken || distance >= nearest) continue;
    nearest = distance;
    parent = other;
  }
  return parent;
}

/// The partner of a mode; a new number if it has none yet, or if that one is in use: then it goes on
/// elsewhere.
int partner_of(int mode, const std::vector<int>& in_use, ModeNumbers& numbers) {
  const auto found = numbers.partners.find(mode);
  if (found != numbers.partners.end()) {
    if (!contains(in_use, found->second)) return found->second;
    forget_partner(mode, numbers);
  }
  const int born = numbers.count++;
  numbers.partners[mode] = born;
  numbers.partners[born] = mode;
  return born;
}

}  // namespace

std::vector<int> modes_of(const std::vector<Track>& tracks) {
  std::vector<int> modes;
  for (const Track& track : tracks) modes.insert(modes.end(), track.modes.begin(), track.modes.end());
  return modes;
}

void order_arrival(Step& step) {
  for (std::size_t i = 0; i < step.right.tracks.size(); ++i) {
    const Track& left = step.left->tracks[i];
    Track& right = step.right.tracks[i];
    right.modes = right.arriving = left.modes;
    if (right.size() == 1) continue;
    double from = 0.0;
    const ComplexVector start = departing_roots(left, step.h, from);
    const HermiteInterpolant functions = functions_on_step(*step.left, step.right, i, step.h);
    right.roots = in_order_of(follow_roots(functions, start, from, 1.0, &right.told_apart), right.roots);
  }
}

std::vector<Birth> order_departure(Step& step, const std::vector<bool>& meets, ModeNumbers& numbers,
                                   const SolveBehind& solve) {
  std::vector<Birth> births;
  for (std::size_t i = 0; i < step.right.tracks.size(); ++i) {
    Track& track = step.right.tracks[i];
    track.departure.reset();
    if (!meets[i]) continue;
    const HermiteInterpolant functions = functions_on_step(*step.left, step.right, i, step.h);
    const double share = std::max(beside_meeting, track.hidden_within / std::abs(step.h));
    const double distance = share * step.h;
    double from = 0.0;
    const ComplexVector start = departing_roots(step.left->tracks[i], step.h, from);
    const double near = 1.0 - share;
    const ComplexVector before = follow_roots(functions, start, from, near, &track.told_apart);
    const ComplexVector earlier = follow_roots(functions, before, near, near - share);
    // Linear extrapolation is right at a crossing. Behind an exceptional point no assignment is better than
    // another.
    const ComplexVector expected = before + 2.0 * (before - earlier);
    track.roots = in_order_of(before, track.roots);
    ComplexVector behind = track.hidden_within > 0.0 ? solve(i, distance) : ComplexVector();
    if (behind.size() == 0) behind = roots_beside(track, distance);
    track.departure = Track::Departure{distance, in_order_of(expected, behind)};
    if (!track.pair.is_real) continue;
    const std::vector<Birth> born = settle_real_block(track, modes_of(step.right.tracks), numbers);
    births.insert(births.end(), born.begin(), born.end());
  }
  return births;
}

std::vector<Birth> order_on_other_path(const PathNode& arrived, double next_step, PathNode& node,
                                       ModeNumbers& numbers) {
  std::vector<Birth> births;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    Track& track = node.tracks[i];
    track.roots = in_order_of(arrived.tracks[i].roots, track.roots);
    track.modes = track.arriving = arrived.tracks[i].arriving;
    if (track.size() == 1) continue;
    // If eigenvalues coincide at the point, their order a little behind it determines the modes.
    const double distance = beside_branch_point * next_step;
    track.departure = Track::Departure{distance, in_order_of(track.roots, roots_beside(track, distance))};
    if (!track.pair.is_real) continue;
    const std::vector<Birth> born = settle_real_block(track, modes_of(node.tracks), numbers);
    births.insert(births.end(), born.begin(), born.end());
  }
  return births;
}

std::vector<Birth> settle_real_block(Track& track, const std::vector<int>& in_use, ModeNumbers& numbers) {
  ComplexVector& roots = track.departure ? track.departure->roots : track.roots;
  settle_pairs(track, roots, numbers);
  std::vector<Birth> births;
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    int& mode = track.modes[static_cast<std::size_t>(i)];
    if (roots[i].imag() != 0.0 || mode != Track::no_mode) continue;
    // A real eigenvalue without a mode was the lower member of a pair that has become two real modes.
    const int parent = parent_of(track, roots, i, numbers);
    mode = partner_of(parent, in_use, numbers);
    births.push_back({parent, mode});
  }
  return births;
}

}  // namespace eigentrail
