#include "continuation/tracks/completeness.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "core/orthonormal.hpp"
#include "core/reciprocal_condition.hpp"
#include "core/singular_vectors.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// Largest difference of both sides of a checksum, as a share of the sum of magnitudes: rounding of
/// ill-conditioned eigenvalues. The loss of a mode that contributes less is not noticed.
constexpr double checksum_tolerance = 1e-7;
/// Reciprocal condition of M or K up to which the sums that need its inverse are left out, as too inaccurate.
constexpr double singular = 1e-9;
/// Largest relative difference of a track from its eigenvalue in the spectrum. QZ gives a double eigenvalue
/// to 1e-8, a triple one to 1e-5.
constexpr double same_root = 1e-4;
/// Largest cost in the assignment, also that of a track or a mode without a counterpart. Far above
/// `same_root`.
constexpr double unrelated = 1e6;
/// A track with a larger backward error is no eigenpair: corrected pairs have errors close to rounding.
constexpr double largest_backward_error = 1e-8;
/// Reciprocal condition of M up to which an eigenvalue may be infinite: its |1/s| is about this share of that
/// of a typical one, squared.
constexpr double singular_mass = 1e-9;

/// All finite eigenvalues that the tracks represent, with the conjugates of complex pairs.
std::vector<Complex> all_eigenvalues(const PathNode& node) {
  std::vector<Complex> all;
  for (const Track& track : node.tracks) {
    for (Eigen::Index i = 0; i < track.size(); ++i) {
      const Complex s = chart_value(track.roots[i], track.pair.chart);
      if (!std::isfinite(s.real())) continue;
      all.push_back(s);
      if (!track.pair.is_real) all.push_back(std::conj(s));
    }
  }
  return all;
}

/// Whether the sums of mu and mu^2 over the eigenvalues mu of mu^2 M + mu C + K agree with the traces. True
/// also if M is too ill-conditioned for the test. Eigenvalues zero may be left out.
bool sums_agree(const Matrix& M, const Matrix& C, const Matrix& K, const std::vector<Complex>& all,
                double reference) {
  const Eigen::PartialPivLU<Matrix> lu(M);
  if (!(reciprocal_condition(lu) > singular)) return true;
  Complex sum = 0.0;
  Complex squares = 0.0;
  double magnitude = reference;
  double square_magnitude = reference * reference;
  for (const Complex mu : all) {
    sum += mu;
    squares += mu * mu;
    magnitude += std::abs(mu);
    square_magnitude += std::norm(mu);
  }
  const Matrix G = lu.solve(C);
  const double trace = -G.trace();
  const double square_trace = G.cwiseProduct(G.transpose()).sum() - 2.0 * lu.solve(K).trace();
  return std::abs(sum - trace) <= checksum_tolerance * magnitude &&
         std::abs(squares - square_trace) <= checksum_tolerance * square_magnitude;
}

bool is_regular(const Matrix& K) {
  return reciprocal_condition(Eigen::PartialPivLU<Matrix>(K)) > singular;
}

/// Median of the magnitudes of the eigenvalues, at least `reference`.
double typical_size(const std::vector<Complex>& all, double reference) {
  if (all.empty()) return reference;
  std::vector<double> sizes;
  for (const Complex s : all) sizes.push_back(std::abs(s));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(*middle, reference);
}

}  // namespace

bool checksum_holds(const PathNode& node, const PathProblem& problem) {
  const ReducedPencil& pencil = node.pencil;
  const Matrix& M = pencil.M[0];
  const Matrix& C = pencil.C[0];
  const Matrix& K = pencil.K[0];
  std::vector<Complex> all = all_eigenvalues(node);
  if (!sums_agree(M, C, K, all, problem.reference(Chart::finite))) return false;
  // The sums of 1 / (s - shift), in which infinite eigenvalues count zero.
  const double shift = is_regular(K) ? 0.0 : typical_size(all, problem.s_ref);
  for (Complex& s : all) s = 1.0 / (s - shift);
  return sums_agree(shift * shift * M + shift * C + K, 2.0 * shift * M + C, M, all,
                    problem.reference(Chart::reciprocal));
}

std::vector<StartingMode> missing_modes(const PathNode& node, const Spectrum& spectrum, double s_ref,
                                        const RoundingThresholds& thresholds) {
  std::vector<Complex> tracked;
  std::vector<double> unknown;  // by rounding
  std::vector<int> parts;
  for (const Track& track : node.tracks) {
    const Vector rounding = rounding_of_roots(track, thresholds);
    for (Eigen::Index i = 0; i < track.size(); ++i) {
      const Complex s = chart_value(track.roots[i], track.pair.chart);
      // In a real block, the members with Im s < 0 are the conjugates of others: the same modes. Where they
      // meet, rounding decides whether there are two real ones.
      const bool is_other = track.pair.is_real && is_lower(track.roots[i], track.pair.chart);
      if (std::isfinite(s.real()) && !(is_other && std::abs(track.roots[i].imag()) > rounding[i])) {
        tracked.push_back(s);
        const double error = track.pair.chart == Chart::finite ? rounding[i] : rounding[i] * std::norm(s);
        unknown.push_back(std::isfinite(error) ? error : 0.0);
        parts.push_back(track.pair.part);
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(tracked.size());
  Matrix cost = Matrix::Constant(n, std::max(n, static_cast<Eigen::Index>(spectrum.modes.size())), unrelated);
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    for (std::size_t j = 0; j < spectrum.modes.size(); ++j) {
      if (spectrum.modes[j].part != parts[i] || spectrum.modes[j].copy > 0) continue;
      const Complex s = spectrum.modes[j].s;
      const double distance = std::min(std::abs(tracked[i] - s), std::abs(std::conj(tracked[i]) - s));
      // Within rounding it is the same, and the nearest one rather than another.
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::min({distance / std::max(std::abs(s), s_ref), same_root * distance / unknown[i], unrelated});
    }
  }
  std::vector<bool> taken(spectrum.modes.size(), false);
  const std::vector<int> assignment = optimal_assignment(cost);
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const int j = assignment[i];
    if (j < static_cast<int>(taken.size()) && cost(static_cast<Eigen::Index>(i), j) <= same_root)
      taken[static_cast<std::size_t>(j)] = true;
  }
  std::vector<StartingMode> missing;
  for (std::size_t j = 0; j < taken.size(); ++j) {
    if (!taken[j] && spectrum.modes[j].copy == 0) missing.push_back(spectrum.modes[j]);
  }
  return missing;
}

namespace {

/// Eigenvector of a root of a track, of unit length, in reduced coordinates.
ComplexVector vector_of(const Track& track, Eigen::Index root) {
  if (track.size() == 1) return track.pair.Z.col(0).normalized();
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(track.pair.Lambda);
  const Eigen::Index nearest = nearest_root(solver.eigenvalues(), track.roots[root]);
  return (track.pair.Z * solver.eigenvectors().col(nearest)).normalized();
}

/// Cosine of the largest angle between the spaces of two tracks, squared.
double resemblance(const ComplexMatrix& a, const ComplexMatrix& b) {
  const auto basis = [](const ComplexMatrix& Z) {
    const Eigen::HouseholderQR<ComplexMatrix> qr(Z);
    return columns_of_Q(qr, std::min(Z.rows(), Z.cols()));
  };
  const ComplexMatrix overlap = basis(a).adjoint() * basis(b);
  const double cosine = singular_vectors(overlap).values.minCoeff();
  return cosine * cosine;
}

}  // namespace

bool have_common_eigenpair(const Track& a, const Track& b, double reference,
                           const IdentityThresholds& thresholds, const Vector& rounding) {
  if (a.pair.part != b.pair.part) return false;
  const ComplexVector others = roots_in_chart(b, a.pair.chart);
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double scale = std::max(std::abs(a.roots[i]), reference);
    const double same = std::max(thresholds.merged_distance * scale, rounding.size() > 0 ? rounding[i] : 0.0);
    if ((others.array() - a.roots[i]).abs().minCoeff() > same) continue;
    const ComplexVector z = vector_of(a, i);
    const ComplexVector outside = z - b.pair.Z * b.pair.Z.colPivHouseholderQr().solve(z);
    if (1.0 - outside.squaredNorm() > thresholds.merged_assurance) return true;
  }
  return false;
}

bool is_followed(const PathProblem& problem, const PathNode& node, const Track& track) {
  const double reference = problem.reference(track.pair.chart);
  const Vector rounding = rounding_of_roots(track, problem.thresholds.rounding);
  return std::any_of(node.tracks.begin(), node.tracks.end(), [&](const Track& other) {
    return have_common_eigenpair(track, other, reference, problem.thresholds.identity, rounding);
  });
}

std::optional<Track> recognize(const PathProblem& problem, const PathNode& node, InvariantPair start,
                               RunCounts& counts) {
  start.factors.reset();
  start.Z = node.basis.coordinates(start.Z, start.part);
  const PencilAtPoint pencil(node.pencil.of(start.part), start.chart);
  InvariantPair pair =
      correct_pair(pencil, start, problem.reference(start.chart), problem.corrector, counts.modes);
  if (pair.status != PairStatus::converged) return std::nullopt;
  if (resemblance(pair.Z, start.Z) < problem.thresholds.identity.least_assurance) return std::nullopt;
  Track track = differentiate_track(problem, node, std::move(pair), counts);
  if (!track.functions.allFinite() || is_followed(problem, node, track)) return std::nullopt;
  return track;
}

bool has_arrived(const PathProblem& problem, const PathNode& node, Complex s,
                 const InfinityThresholds& thresholds) {
  if (std::abs(s) <= thresholds.arrived * problem.s_max) return true;
  return reciprocal_condition(Eigen::PartialPivLU<Matrix>(node.pencil.M[0])) > singular_mass;
}

bool has_doubtful_track(const PathNode& node, const PathProblem& problem) {
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    const Track& track = node.tracks[i];
    if (track.pair.backward_error > largest_backward_error) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (have_common_eigenpair(track, node.tracks[j], problem.reference(track.pair.chart),
                                problem.thresholds.identity))
        return true;
    }
  }
  return false;
}

namespace {

/// A track of a complex eigenvalue as the track of its conjugate.
Track conjugated(const Track& track) {
  Track result;
  result.pair = conjugated(track.pair);
  result.roots = track.roots.conjugate();
  return result;
}

/// Whether a track follows one numbered mode, whose eigenvalue is apart from its conjugate.
bool is_complex(const Track& track, double reference, double merged_distance) {
  return track.size() == 1 && track.modes[0] >= 0 && !track.pair.is_real &&
         2.0 * std::abs(track.roots[0].imag()) >
             merged_distance * std::max(std::abs(track.roots[0]), reference);
}

/// In a real block, a complex pair is two members, of which only that with Im s > 0 has a mode. Two that are
/// a pair by rounding alone may be real.
void end_conjugates_within(Track& track, const RoundingThresholds& thresholds, std::vector<OnePair>& pairs) {
  if (!track.pair.is_real) return;
  const Vector rounding = rounding_of_roots(track, thresholds);
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    int& below = track.modes[static_cast<std::size_t>(i)];
    const Complex root = track.roots[i];
    if (below < 0 || !is_lower(root, track.pair.chart)) continue;
    if (std::abs(root.imag()) <= rounding[i]) continue;
    const Eigen::Index other = conjugate_of(track.roots, i);
    int& above = track.modes[static_cast<std::size_t>(other)];
    if (above >= 0) pairs.push_back({std::min(above, below), std::max(above, below)});
    above = above >= 0 ? std::min(above, below) : below;
    below = Track::no_mode;
  }
}

/// Ends every mode that is the conjugate of one before it.
std::vector<OnePair> end_conjugates(const PathProblem& problem, PathNode& node) {
  std::vector<OnePair> pairs;
  const IdentityThresholds& thresholds = problem.thresholds.identity;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    Track& kept = node.tracks[i];
    const double reference = problem.reference(kept.pair.chart);
    end_conjugates_within(kept, problem.thresholds.rounding, pairs);
    if (!is_complex(kept, reference, thresholds.merged_distance)) continue;
    const Track other = conjugated(kept);
    for (std::size_t j = node.tracks.size() - 1; j > i; --j) {
      const Track& candidate = node.tracks[j];
      if (candidate.size() != 1 || candidate.modes[0] < 0 ||
          !have_common_eigenpair(candidate, other, reference, thresholds))
        continue;
      pairs.push_back({kept.modes[0], candidate.modes[0]});
      node.tracks.erase(node.tracks.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
  return pairs;
}

/// The missing modes, grouped into single modes and blocks.
std::vector<StartingGroup> missing_groups(const PathProblem& problem, const PathNode& node,
                                          RunCounts& counts) {
  const ReducedPencil& pencil = node.pencil;
  const Spectrum spectrum = compute_spectrum(pencil);
  ++counts.spectra;
  if (spectrum.status != SpectrumStatus::complete) return {};
  std::vector<StartingMode> missing =
      missing_modes(node, spectrum, problem.s_ref, problem.thresholds.rounding);
  std::erase_if(missing, [&](const StartingMode& mode) { return !has_arrived(problem, node, mode.s); });
  return starting_groups(pencil, missing, static_cast<int>(missing.size()), problem.s_ref);
}

}  // namespace

Completion complete(const PathProblem& problem, bool follows_all, PathNode& node, ModeNumbers& numbers,
                    RunCounts& counts) {
  const StageTimer timer(counts.matching_seconds);
  Completion found;
  const bool meeting = std::any_of(node.tracks.begin(), node.tracks.end(),
                                   [](const Track& track) { return track.departure.has_value(); });
  if (meeting) return found;
  found.pairs = end_conjugates(problem, node);
  for (const OnePair& pair : found.pairs) {
    numbers.partners[pair.kept] = pair.ended;
    numbers.partners[pair.ended] = pair.kept;
  }
  found.doubtful = has_doubtful_track(node, problem);
  if (!follows_all || checksum_holds(node, problem)) return found;
  for (const StartingGroup& group : missing_groups(problem, node, counts)) {
    std::optional<Track> track = track_of(problem, node, group, counts);
    if (!track) continue;
    for (int& mode : track->modes) mode = mode >= 0 ? numbers.count++ : mode;
    track->arriving = track->modes;
    node.tracks.push_back(std::move(*track));
    ++found.added;
  }
  return found;
}

}  // namespace eigentrail
