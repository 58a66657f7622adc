#include "continuation/tracks/guard_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "continuation/point/point_solver.hpp"
#include "continuation/tracks/completeness.hpp"
#include "continuation/tracks/members.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "modes/energy_stability.hpp"

namespace eigentrail {
namespace {

/// Largest number of eigenvalues that are looked at. The one that matters is nearly always the nearest.
constexpr std::size_t most_neighbours = 3;
/// Number of eigenvalues that are computed beside those of the track. The farthest ones of a subspace are
/// inaccurate; a conjugate takes a place, too.
constexpr Eigen::Index beside = 12;
/// Largest number of freedoms for which the companion form is factorized.
constexpr Eigen::Index most_freedoms = 1000;

/// Relative imaginary part up to which an eigenvalue of the subspace counts as real, and relative distance up
/// to which two count as one: its accuracy before the correction.
constexpr double real_axis = 1e-8;
constexpr double same = 1e-6;

/// The eigenvalue of a track whose series has the smallest radius of convergence, as the growth of its terms
/// says: a meeting with another eigenvalue is the reason. One without a series coincides with another one of
/// the track; it comes first.
Complex most_restless(const Track& track) {
  Complex restless = track.roots[0];
  double most = 0.0;
  for (const Complex root : track.roots) {
    const ComplexVector series = root_series(track.functions, root);
    if (series.size() == 0) return root;
    const Eigen::Index last = series.size() - 1;
    const double slope = std::abs(series[std::min<Eigen::Index>(1, last)]);
    const double growth =
        slope > 0.0 ? std::pow(std::abs(series[last]) / slope, 1.0 / std::max(1.0, last - 1.0)) : 0.0;
    if (growth <= most) continue;
    most = growth;
    restless = root;
  }
  return restless;
}

/// The eigenvalues of a subspace, Im s >= 0 or < 0, with their vectors in the columns of Z. Those of a real
/// subspace are exactly real, or conjugates of each other, however inaccurate it is.
struct RitzPairs {
  ComplexVector s;
  ComplexMatrix Z;
};

RitzPairs ritz_pairs(const InvariantPair& pair) {
  if (pair.is_real) {
    const Eigen::EigenSolver<Matrix> solver(Matrix(pair.Lambda.real()));
    return {solver.eigenvalues(), pair.Z * solver.eigenvectors()};
  }
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(pair.Lambda);
  return {solver.eigenvalues(), pair.Z * solver.eigenvectors()};
}

/// The vector of a real eigenvalue, which is real but for its phase.
ComplexVector real_vector(const ComplexVector& z) {
  Eigen::Index largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  return (z * (std::abs(z[largest]) / z[largest])).real().cast<Complex>();
}

/// The eigenvalues about `centre`, one of a track, by inverse iteration: with a real subspace about a real
/// one.
Spectrum spectrum_beside(const ReducedPencil& pencil, const Track& track, Complex centre) {
  const bool is_complex_part = pencil.complex_sign != 0;
  const Eigen::Index size = std::min(track.size() + beside, (is_complex_part ? 1 : 2) * pencil.size());
  const InvariantPair pair = invariant_subspace(pencil, centre, size, centre.imag() == 0.0);
  Spectrum spectrum;
  if (!pair.Z.allFinite() || !pair.Lambda.allFinite()) return spectrum;
  const RitzPairs ritz = ritz_pairs(pair);
  for (Eigen::Index i = 0; i < size; ++i) {
    Complex s = ritz.s[i];
    ComplexVector z = ritz.Z.col(i).normalized();
    if (is_complex_part && s.imag() < 0.0) continue;  // the conjugate of a mode of the conjugate part
    if (s.imag() < 0.0) {
      s = std::conj(s);
      z = z.conjugate();
    }
    if (!is_complex_part && s.imag() <= real_axis * std::abs(s)) {
      z = real_vector(z);
      s = s.real();
    }
    const bool is_known = std::any_of(spectrum.modes.begin(), spectrum.modes.end(), [&](const auto& mode) {
      return std::abs(mode.s - s) <= same * std::abs(s);
    });
    if (!is_known) spectrum.modes.push_back({s, std::move(z), track.pair.part});
  }
  spectrum.status = SpectrumStatus::complete;
  return spectrum;
}

/// The eigenvalues nearest to a track that no track has.
std::vector<StartingMode> neighbours_of(const PathProblem& problem, const PathNode& node,
                                        const Track& track) {
  const Complex centre = chart_value(most_restless(track), track.pair.chart);
  const Spectrum spectrum = spectrum_beside(node.pencil.of(track.pair.part), track, centre);
  if (spectrum.status != SpectrumStatus::complete) return {};
  std::vector<StartingMode> others =
      missing_modes(node, spectrum, problem.s_ref, problem.thresholds.rounding);
  const auto distance = [&](Complex s) {
    return std::min(std::abs(centre - s), std::abs(centre - std::conj(s)));
  };
  std::stable_sort(others.begin(), others.end(), [&](const StartingMode& a, const StartingMode& b) {
    return distance(a.s) < distance(b.s);
  });
  if (others.size() > most_neighbours) others.resize(most_neighbours);
  return others;
}

/// A pair that was corrected from an inaccurate start as the member with Im s >= 0: else the conjugate of a
/// followed mode would be taken for another one. A complex start may have led to a real eigenvalue: in a
/// complex block that one could not be told from its conjugate where the block meets its own.
InvariantPair upper_member(const PencilAtPoint& pencil, InvariantPair pair, bool is_complex_part,
                           double s_ref, const CorrectorOptions& options, ModeCounts& counts) {
  if (pair.size() != 1 || pair.is_real) return pair;
  const Complex s = pair.eigenvalue();
  if (!is_complex_part && std::abs(s.imag()) <= real_axis * std::abs(s)) {
    InvariantPair start = pair;
    start.Z = real_vector(pair.Z.col(0));
    start.Lambda = s.real() * ComplexMatrix::Identity(1, 1);
    start.is_real = true;
    start.factors.reset();
    InvariantPair real = correct_pair(pencil, start, s_ref, options, counts);
    if (real.status == PairStatus::converged) return real;
  }
  return s.imag() < 0.0 ? conjugated(pair) : pair;
}

}  // namespace

void add_neighbours(const PathProblem& problem, PathNode& node, std::size_t track, RunCounts& counts) {
  if (node.pencil.of(node.tracks[track].pair.part).size() > most_freedoms) return;
  const StageTimer timer(counts.matching_seconds);
  const std::vector<StartingMode> others = neighbours_of(problem, node, node.tracks[track]);
  for (const StartingGroup& group :
       starting_groups(node.pencil, others, static_cast<int>(others.size()), problem.s_ref)) {
    const PencilAtPoint pencil(node.pencil.of(group.pair.part));
    InvariantPair pair = correct_pair(pencil, group.pair, problem.s_ref, problem.corrector, counts.modes);
    if (pair.status != PairStatus::converged) continue;
    pair = upper_member(pencil, std::move(pair), node.pencil.of(group.pair.part).complex_sign != 0,
                        problem.s_ref, problem.corrector, counts.modes);
    Track guard = differentiate_track(problem, node, std::move(pair), counts);
    if (!guard.functions.allFinite()) continue;
    if (is_followed(problem, node, guard)) continue;
    guard.roots = in_order_of(group.roots, guard.roots);
    guard.modes.assign(group.modes.size(), Track::guard);
    node.tracks.push_back(std::move(guard));
  }
}

void remove_guards(PathNode& node) {
  std::erase_if(node.tracks, [](const Track& track) {
    return std::all_of(track.modes.begin(), track.modes.end(), [](int mode) { return mode < 0; });
  });
}

bool join_unfollowed(const PathProblem& problem, PathNode& node, std::size_t track, double h, double reach,
                     RunCounts& counts) {
  const std::size_t followed = node.tracks.size();
  add_neighbours(problem, node, track, counts);
  std::vector<Partner> partners = limiting_partners(node, track, h, reach);
  std::erase_if(partners, [&](const Partner& one) { return one.conjugate || one.track < followed; });
  bool joined = false;
  if (!partners.empty()) {
    joined = join(problem, node, track, {partners.front()}, counts);
  } else {
    const std::optional<Partner> nearest = nearest_partner(node, track);
    joined = nearest && !nearest->conjugate && nearest->track >= followed &&
             may_limit(node, track, *nearest) && join_and_keep(problem, node, track, *nearest, counts);
  }
  remove_guards(node);
  return joined;
}

namespace {

/// Gives numbers to the wanted modes of a track, and adds it to a point. Returns their number.
int add(Track track, PathNode& node, ModeNumbers& numbers) {
  int added = 0;
  for (int& mode : track.modes) {
    if (mode < 0) continue;
    mode = numbers.count++;
    ++added;
  }
  track.arriving = track.modes;
  node.tracks.push_back(std::move(track));
  return added;
}

/// Number of eigenvalues of a spectrum with Re s > 0; a complex pair counts once.
int growing_roots(const ComplexVector& roots) {
  return static_cast<int>((roots.real().array() > 0.0 && roots.imag().array() >= 0.0).count());
}

/// Makes guard modes of the modes of a track that are not needed: neither wanted, nor growing by more than
/// rounding. Returns whether any is.
template <class IsWanted>
bool dismiss_unneeded(const PathProblem& problem, const IsWanted& is_wanted, Track& track) {
  const Vector rounding = rounding_of_roots(track, problem.thresholds.rounding);
  bool any = false;
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    int& mode = track.modes[static_cast<std::size_t>(i)];
    const bool grows = track.roots[i].real() > rounding[i];  // also of 1/s
    if (mode >= 0 && !grows && !is_wanted(chart_value(track.roots[i], track.pair.chart))) mode = Track::guard;
    any = any || mode >= 0;
  }
  return any;
}

/// An entering mode in a block with the mode that nobody follows and that it meets on a step of length h, or
/// near it; empty if there is none.
std::optional<Track> with_partner(const PathProblem& problem, const Track& entering_mode, double h,
                                  double reach, PathNode node, RunCounts& counts) {
  node.tracks.push_back(entering_mode);
  if (!join_unfollowed(problem, node, node.tracks.size() - 1, h, reach, counts)) return std::nullopt;
  return std::move(node.tracks.back());
}

/// An entering mode at the left end of the step of length h behind which it was noticed; empty if it is not
/// recognized there, or followed already.
std::optional<Track> at_left_end(const PathProblem& problem, const Track& entering_mode, double h,
                                 const PathNode& left, RunCounts& counts) {
  auto track = recognize(problem, left, predicted_pair(entering_mode, -h), counts);
  if (!track) return std::nullopt;
  const ComplexVector expected = block_roots(evaluate_series(entering_mode.functions, -h));
  track->modes = entering_mode.modes;
  track->roots = in_order_of(in_order_of(entering_mode.roots, expected), track->roots);
  return track;
}

}  // namespace

EnteringModes entering_modes(const PathProblem& problem, const ModeChoice& choice, const PathNode& node,
                             RunCounts& counts) {
  const bool is_whole = problem.model.projection() == nullptr;
  if (!is_whole && !choice.may_grow()) return {};
  const StageTimer timer(counts.matching_seconds);
  const bool may_grow = is_whole && !is_stable_by_energy(node.pencil, problem.structure);
  if (!choice.may_grow() && !may_grow) return {{}, 0};
  const Spectrum spectrum = compute_eigenvalues(node.pencil);
  ++counts.spectra;
  if (spectrum.status != SpectrumStatus::complete) return {};
  const auto is_wanted = [&](Complex s) { return choice.may_grow() && choice.wants(s); };
  std::vector<StartingMode> others =
      missing_modes(node, spectrum, problem.s_ref, problem.thresholds.rounding);
  const auto needed_end = std::stable_partition(others.begin(), others.end(), [&](const StartingMode& mode) {
    return (is_wanted(mode.s) || (may_grow && mode.s.real() > 0.0)) && has_arrived(problem, node, mode.s);
  });
  EnteringModes found{{}, is_whole ? 0 : -1};
  for (const StartingGroup& group :
       starting_groups(node.pencil, others, static_cast<int>(needed_end - others.begin()), problem.s_ref)) {
    std::optional<Track> track = track_of(problem, node, group, counts);
    if (!track) {
      if (may_grow) found.growing += growing_roots(group.roots);
      continue;
    }
    if (is_followed(problem, node, *track)) continue;
    if (dismiss_unneeded(problem, is_wanted, *track)) found.tracks.push_back(std::move(*track));
  }
  return found;
}

int follow_back(const PathProblem& problem, const std::vector<Track>& entering_modes, double h,
                const PathNode& right, double reach, PathNode& left, ModeNumbers& numbers,
                RunCounts& counts) {
  int added = 0;
  for (const Track& entering_mode : entering_modes) {
    auto track = at_left_end(problem, entering_mode, h, left, counts);
    if (!track) {
      if (const auto block = with_partner(problem, entering_mode, -h, reach, right, counts))
        track = at_left_end(problem, *block, h, left, counts);
    }
    if (track) added += add(std::move(*track), left, numbers);
  }
  return added;
}

int number_growing_guards(const PathProblem& problem, const PathNode& right, PathNode& left,
                          ModeNumbers& numbers) {
  int found = 0;
  for (std::size_t t = 0; t < right.tracks.size(); ++t) {
    const Track& end = right.tracks[t];
    Track& begin = left.tracks[t];
    if (!contains(begin.modes, Track::guard)) continue;
    const Vector rounding = rounding_of_roots(end, problem.thresholds.rounding);
    const ComplexVector& roots = begin.departure ? begin.departure->roots : begin.roots;
    for (Eigen::Index i = 0; i < end.size(); ++i) {
      const bool grows = end.roots[i].real() > rounding[i];
      if (begin.modes[static_cast<std::size_t>(i)] != Track::guard || !grows) continue;
      // Of a pair in a real block the member with Im s > 0 has the number.
      const Eigen::Index other = begin.pair.is_real ? conjugate_of(roots, i) : i;
      const bool is_upper = !is_lower(roots[i], begin.pair.chart);
      begin.modes[static_cast<std::size_t>(is_upper ? other : i)] = Track::no_mode;
      begin.modes[static_cast<std::size_t>(is_upper ? i : other)] = numbers.count++;
      ++found;
    }
  }
  return found;
}

int begin_here(const PathProblem& problem, std::vector<Track> entering_modes, PathNode& node,
               ModeNumbers& numbers) {
  int added = 0;
  for (Track& entering_mode : entering_modes) {
    if (!is_followed(problem, node, entering_mode)) added += add(std::move(entering_mode), node, numbers);
  }
  return added;
}

}  // namespace eigentrail
