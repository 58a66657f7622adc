#include "continuation/tracks/regrouping.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "continuation/tracks/eigenvalue_branches.hpp"
#include "continuation/tracks/members.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// Blocks up to this size may hold all 2n eigenvalues of a small pencil. Larger ones hold at most n: nearly a
/// whole spectrum as one block says nothing about its parts, and its functions are ill-conditioned.
constexpr Eigen::Index small_block = 6;
/// Eigenvalues are separated if their error as single modes is below this share of the accepted one: in
/// blocks of two, which cost little to keep, and in larger blocks, whose eigenvalues are harder to identify.
constexpr double parting_error = 0.03;
constexpr double bystander_error = 0.5;
/// A part of a block can be separated if its distance from the others is more than this many times its
/// diameter.
constexpr double isolated = 3.0;
/// Eigenvalues that are joined because they are close stay together up to this multiple of their distance.
/// With a smaller one they are joined again soon; a larger one keeps blocks, which cost more than single
/// modes.
constexpr double kept_together = 3.0;
/// The other chart is preferred if its last term is less than this share of that of the present chart,
/// relative to the eigenvalue, ...
constexpr double much_smaller_term = 0.2;
/// ... and the eigenvalue changes by more than this share of itself on the step. Otherwise both charts are
/// alike.
constexpr double least_change = 0.2;

/// Largest size of a block of a pencil of size n, if it is limited to `largest`.
Eigen::Index largest_block_of(Eigen::Index n, Eigen::Index largest) {
  return std::min({largest, std::max(small_block, n), 2 * n});
}

/// Replaces the tracks with the given indices by one track at the end of the list.
void replace(PathNode& node, std::vector<std::size_t> old, Track track) {
  std::sort(old.rbegin(), old.rend());
  for (const std::size_t i : old) node.tracks.erase(node.tracks.begin() + static_cast<std::ptrdiff_t>(i));
  node.tracks.push_back(std::move(track));
}

/// The smallest distance of the departures of these tracks (Track::departure); empty if none of them has one.
std::optional<double> departure_distance(const PathNode& node, const std::vector<std::size_t>& members) {
  std::optional<double> distance;
  for (const std::size_t i : members) {
    const auto& departure = node.tracks[i].departure;
    if (departure && (!distance || std::abs(departure->distance) < std::abs(*distance)))
      distance = departure->distance;
  }
  return distance;
}

/// Roots of a track at a distance from the node, in the order of its modes.
ComplexVector roots_at_departure(const Track& track, double distance) {
  double position = 0.0;
  const ComplexVector start = departing_roots(track, distance / farthest_departure, position);
  const ComplexVector roots = block_roots(evaluate_series(track.functions, distance));
  return in_order_of(start, roots);
}

/// Adds roots to a list: their reciprocals in the other chart, and after them their conjugates if requested.
void append(const ComplexVector& roots, bool other_chart, bool with_conjugates, std::vector<Complex>& all) {
  const std::size_t first = all.size();
  for (const Complex root : roots) all.push_back(other_chart ? 1.0 / root : root);
  if (!with_conjugates) return;
  for (std::size_t i = first, end = all.size(); i < end; ++i) all.push_back(std::conj(all[i]));
}

/// The block with these eigenvalues in the chart and the part of `one`, by inverse iteration. Where vectors
/// are parallel to rounding, only their space can be computed, not the vectors one by one.
InvariantPair subspace_of(const PathNode& node, const InvariantPair& one, const ComplexVector& values,
                          bool is_real) {
  const ComplexVector s = one.chart == Chart::finite ? values : ComplexVector(values.cwiseInverse());
  const Complex centre = is_real ? Complex(s.mean().real()) : s.mean();
  InvariantPair pair = invariant_subspace(node.pencil.of(one.part), centre, s.size(), is_real);
  pair.part = one.part;
  return one.chart == Chart::finite ? pair : in_other_chart(pair);
}

/// Whether a block has the eigenvalues that its members had, as far as these were known.
bool has_eigenvalues(const Track& block, const ComplexVector& known) {
  constexpr double rounding = 1e4;  // in units of that of a matrix: errors of the corrector, with a margin
  const Vector errors =
      root_errors(block.functions.col(0), block.roots, rounding * function_rounding(block.pair.Lambda));
  return ((block.roots - known).cwiseAbs().array() <= errors.array()).all();
}

}  // namespace

bool join(const PathProblem& problem, PathNode& node, std::size_t index, const std::vector<Partner>& partners,
          RunCounts& counts, Eigen::Index largest) {
  const StageTimer timer(counts.modes_seconds);
  std::vector<std::size_t> members{index};
  bool make_real = false;
  for (const Partner& partner : partners) {
    if (!partner.conjugate) members.push_back(partner.track);
    make_real = make_real || partner.conjugate;
  }
  std::vector<InvariantPair> pairs;
  for (const std::size_t i : members) {
    make_real = make_real || node.tracks[i].pair.is_real;
    pairs.push_back(node.tracks[i].pair);
    if (pairs.back().chart != node.tracks[index].pair.chart) pairs.back() = in_other_chart(pairs.back());
  }
  std::vector<const InvariantPair*> parts;
  std::vector<Complex> known, departing;
  std::vector<int> modes, met;
  double inseparable = 0.0;
  const std::optional<double> departure = departure_distance(node, members);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Track& track = node.tracks[members[i]];
    parts.push_back(&pairs[i]);
    inseparable = std::max(inseparable, track.inseparable);
    const bool other_chart = track.pair.chart != node.tracks[index].pair.chart;
    const bool with_conjugates = make_real && !track.pair.is_real;
    for (const int j : track.met) met.push_back(static_cast<int>(known.size()) + j);
    append(track.roots, other_chart, with_conjugates, known);
    if (departure) append(roots_at_departure(track, *departure), other_chart, with_conjugates, departing);
    modes.insert(modes.end(), track.modes.begin(), track.modes.end());
    // The conjugate of a guard mode is one, too.
    if (with_conjugates) {
      std::transform(track.modes.begin(), track.modes.end(), std::back_inserter(modes),
                     [](int mode) { return mode >= 0 ? Track::no_mode : Track::guard; });
    }
  }
  if (static_cast<Eigen::Index>(known.size()) >
      largest_block_of(node.pencil.of(pairs[0].part).size(), largest))
    return false;
  const ComplexVector values =
      Eigen::Map<ComplexVector>(known.data(), static_cast<Eigen::Index>(known.size()));
  const auto block = [&](const InvariantPair& start) {
    std::optional<Track> track = track_of(problem, node, {start, values, modes}, counts);
    return track && has_eigenvalues(*track, values) ? track : std::nullopt;
  };
  std::optional<Track> joined = block(join_pairs(parts, make_real));
  if (!joined) joined = block(subspace_of(node, *parts.front(), values, make_real));
  if (!joined) return false;
  joined->met = std::move(met);
  joined->inseparable = inseparable;
  if (departure) {
    joined->departure =
        Track::Departure{*departure, Eigen::Map<ComplexVector>(departing.data(), values.size())};
  }
  replace(node, members, std::move(*joined));
  return true;
}

bool join_and_keep(const PathProblem& problem, PathNode& node, std::size_t track, const Partner& partner,
                   RunCounts& counts, Eigen::Index largest) {
  if (!join(problem, node, track, {partner}, counts, largest)) return false;
  double& inseparable = node.tracks.back().inseparable;
  inseparable = std::max(inseparable, kept_together * partner.distance);
  return true;
}

namespace {

/// Two eigenvalues of a block count as equal if they differ by no more, relative to the norm of the block or
/// to the reference magnitude if that is larger: about the square root of rounding, the accuracy of a double
/// eigenvalue.
constexpr double told_apart = 1e-5;

/// Distance up to which eigenvalues of a block count as equal. `reference`: magnitude below which eigenvalues
/// count as zero. It is the scale where a pair passes through the origin and the block itself is nearly zero.
double rounding_of_eigenvalues(const Track& track, double reference) {
  return told_apart * std::max(track.pair.Lambda.norm(), reference);
}

/// Indices with the same label, below their number, as lists.
std::vector<std::vector<int>> by_label(const std::vector<int>& labels) {
  std::vector<std::vector<int>> result(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    result[static_cast<std::size_t>(labels[i])].push_back(static_cast<int>(i));
  std::erase_if(result, [](const std::vector<int>& members) { return members.empty(); });
  return result;
}

/// Index of the conjugate of every root of a real block; of the root itself in others.
std::vector<int> conjugates_of(const Track& track) {
  std::vector<int> conjugates(static_cast<std::size_t>(track.size()));
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    const Eigen::Index j = track.pair.is_real ? conjugate_of(track.roots, i) : i;
    conjugates[static_cast<std::size_t>(i)] = static_cast<int>(j);
  }
  return conjugates;
}

/// Groups of the eigenvalues of a block, as lists of indices. Two belong to the same group if they, or their
/// conjugates, are connected by meetings within the reach of a step to either side.
std::vector<std::vector<int>> groups(const Track& track, double reference, double h, double reach) {
  const Eigen::Index k = track.size();
  std::vector<int> group(static_cast<std::size_t>(k));
  std::iota(group.begin(), group.end(), 0);
  std::vector<ComplexVector> series;
  for (const Complex root : track.roots) series.push_back(root_series(track.functions, root));
  const double limit = reach * std::abs(h);
  const double equal = rounding_of_eigenvalues(track, reference);
  const std::vector<int> conjugates = conjugates_of(track);
  const auto unite = [&group](std::size_t i, std::size_t j) {
    std::replace(group.begin(), group.end(), int(group[i]), int(group[j]));
  };
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const auto& a = series[static_cast<std::size_t>(i)];
      const auto& b = series[static_cast<std::size_t>(j)];
      const bool apart = std::abs(track.roots[i] - track.roots[j]) > equal && a.size() > 0 && b.size() > 0;
      // Meetings at places where the series are not accurate count, so that the eigenvalues stay together:
      // close to a meeting of three or more eigenvalues no series converges.
      const bool linked = !apart || meeting_distance(a, b, 0.0, h, limit, Doubtful::counts) < limit ||
                          meeting_distance(a, b, 0.0, -h, limit, Doubtful::counts) < limit;
      if (!linked) continue;
      const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(j);
      unite(first, second);
      unite(static_cast<std::size_t>(conjugates[first]), static_cast<std::size_t>(conjugates[second]));
    }
  }
  return by_label(group);
}

/// Unites groups whose eigenvalues are inseparable.
std::vector<std::vector<int>> with_inseparable(const Track& track, std::vector<std::vector<int>> groups) {
  const auto close = [&](const std::vector<int>& a, const std::vector<int>& b) {
    return std::any_of(a.begin(), a.end(), [&](int i) {
      return std::any_of(b.begin(), b.end(), [&](int j) {
        return std::abs(track.roots[i] - track.roots[j]) < track.inseparable;
      });
    });
  };
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size();) {
      if (!close(groups[a], groups[b])) {
        ++b;
        continue;
      }
      groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
      groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
      b = a + 1;  // the group has grown: those before may be close to it now
    }
  }
  return groups;
}

/// Groups of the eigenvalues of a block by their errors as single modes: each with less than the accepted
/// error by itself, and all others as one block. Conjugates have the same error but for rounding.
std::vector<std::vector<int>> without_bystanders(const Vector& errors, const std::vector<int>& conjugates,
                                                 double accepted) {
  std::vector<std::vector<int>> members;
  std::vector<int> rest;
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    if (std::max(errors[i], errors[conjugates[static_cast<std::size_t>(i)]]) < accepted) {
      members.push_back({static_cast<int>(i)});
    } else {
      rest.push_back(static_cast<int>(i));
    }
  }
  // A single eigenvalue with a large error needs a partner: then the block stays together.
  if (rest.size() == 1) return {};
  if (!rest.empty()) members.push_back(std::move(rest));
  return members;
}

/// Whether the groups can be separated. Eigenvalues of different groups whose distance is small against the
/// norm of the centred Lambda (less the mean times the unit matrix) are nearly defective; then they cannot.
/// Nor can those that count as equal: in the series of a single one every term has the rounding of the term
/// before it, divided by their distance.
bool are_told_apart(const Track& block, const std::vector<std::vector<int>>& groups, double reference) {
  // The condition of the eigenvectors is about the reciprocal of this share.
  constexpr double nearly_defective = 1e-4;
  ComplexMatrix N = block.pair.Lambda;
  N.diagonal().array() -= block.roots.mean();
  double gap = INFINITY;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (const int i : groups[a]) {
        for (const int j : groups[b]) gap = std::min(gap, std::abs(block.roots[i] - block.roots[j]));
      }
    }
  }
  return gap > std::max(nearly_defective * N.norm(), rounding_of_eigenvalues(block, reference));
}

/// Some members of a block as a track; empty if that fails.
std::optional<Track> track_of_members(const PathProblem& problem, const PathNode& node, const Track& block,
                                      const std::vector<int>& members, RunCounts& counts) {
  StartingGroup group{part_of(block.pair, block.roots, members), block.roots(members), {}};
  for (const int i : members) group.modes.push_back(block.modes[static_cast<std::size_t>(i)]);
  std::optional<Track> track = track_of(problem, node, group, counts);
  if (!track) return std::nullopt;
  track->inseparable = members.size() > 1 ? block.inseparable : 0.0;
  if (block.departure)
    track->departure = Track::Departure{block.departure->distance, block.departure->roots(members)};
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (contains(block.met, members[i])) track->met.push_back(static_cast<int>(i));
  }
  return track;
}

/// The tracks into which a block is separated; empty if one of them does not converge.
std::vector<Track> parts_of(const PathProblem& problem, const PathNode& node, const Track& block,
                            const std::vector<std::vector<int>>& groups, RunCounts& counts) {
  std::vector<Track> parts;
  for (const std::vector<int>& members : groups) {
    // Groups of conjugates and guard modes only are not followed.
    if (std::all_of(members.begin(), members.end(),
                    [&](int i) { return block.modes[static_cast<std::size_t>(i)] < 0; }))
      continue;
    std::optional<Track> track = track_of_members(problem, node, block, members, counts);
    if (!track) return {};
    parts.push_back(std::move(*track));
  }
  return parts;
}

}  // namespace

std::optional<Track> separate(const PathProblem& problem, const PathNode& node, const Track& track,
                              const std::vector<int>& members, RunCounts& counts) {
  if (static_cast<Eigen::Index>(members.size()) == track.size()) return track;
  const bool is_isolated =
      distance_from_others(track.roots, members) > isolated * diameter(track.roots, members);
  if (!is_isolated) return std::nullopt;
  return track_of_members(problem, node, track, members, counts);
}

std::optional<Track> without(const PathProblem& problem, const PathNode& node, const Track& track,
                             const std::vector<int>& members, RunCounts& counts) {
  const std::vector<int> others = other_members(track.size(), members);
  if (!are_told_apart(track, {members, others}, problem.reference(track.pair.chart))) return std::nullopt;
  return track_of_members(problem, node, track, others, counts);
}

void part(const PathProblem& problem, const PathNode* left, PathNode& node, double h, double last_step,
          const PartingRules& rules, RunCounts& counts) {
  const StageTimer timer(counts.modes_seconds);
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    Track& track = node.tracks[i];
    std::vector<Track> parts;
    if (track.size() > 1) {
      const double reference = problem.reference(track.pair.chart);
      auto members = groups(track, reference, h, rules.reach);
      const bool comparable =
          left != nullptr && i < left->tracks.size() && left->tracks[i].size() == track.size();
      if (members.size() == 1 && comparable) {
        const double share = track.size() == 2 ? parting_error : bystander_error;
        // Errors on the next step, which may be longer: they grow like the length to the power 2 order + 2.
        const double growth = std::pow(std::abs(h / last_step), 2.0 * problem.order + 2.0);
        members = without_bystanders(growth * errors_as_singles(problem, *left, node, i, last_step),
                                     conjugates_of(track), share * rules.accepted);
      }
      members = with_inseparable(track, std::move(members));
      if (members.size() > 1 && are_told_apart(track, members, reference))
        parts = parts_of(problem, node, track, members, counts);
    }
    if (parts.empty()) {
      tracks.push_back(std::move(track));
    } else {
      std::move(parts.begin(), parts.end(), std::back_inserter(tracks));
    }
  }
  node.tracks = std::move(tracks);
}

bool prefers_other_chart(const Track& track, double h) {
  if (track.size() != 1 || track.functions(0, 0) == 0.0) return false;
  const ComplexVector here = track.functions.row(0).transpose();
  const ComplexVector there = reciprocal_series(here);
  const auto tail = [h](const ComplexVector& series) {
    const Eigen::Index last = series.size() - 1;
    return std::abs(series[last]) * std::pow(std::abs(h), static_cast<double>(last)) / std::abs(series[0]);
  };
  return std::abs(here[1] * h) > least_change * std::abs(here[0]) &&
         tail(there) < much_smaller_term * tail(here);
}

bool change_chart(const PathProblem& problem, PathNode& node, std::size_t index, RunCounts& counts) {
  Track& track = node.tracks[index];
  if (track.size() != 1 || track.roots[0] == 0.0) return false;
  std::optional<Track> other =
      track_of(problem, node, {in_other_chart(track.pair), track.roots.cwiseInverse(), track.modes}, counts);
  if (!other) return false;
  other->arriving = track.arriving;
  track = std::move(*other);
  return true;
}

}  // namespace eigentrail
