#include "continuation/tracks/recognition.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "continuation/tracks/completeness.hpp"
#include "core/orthonormal.hpp"
#include "core/singular_vectors.hpp"
#include "eigentrail/continuation/point_modes.hpp"

namespace eigentrail {
namespace {

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

bool is_followed(const PathProblem& problem, const PathNode& node, const Track& track) {
  const double reference = problem.reference(track.pair.chart);
  return std::any_of(node.tracks.begin(), node.tracks.end(), [&](const Track& other) {
    return have_common_eigenpair(track, other, reference, problem.thresholds.identity);
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

}  // namespace eigentrail
