#include "continuation/tracks/ended_modes.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <sstream>

#include "continuation/tracks/completeness.hpp"
#include "core/singular_vectors.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Points at which an ended track is looked for. The farther away, the less its last pair is a start for
/// Newton's method; each look costs some factorizations.
constexpr int most_looks = 10;

/// Name of the coordinate with the largest amplitude in a shape.
const std::string& largest_motion(const Model& model, const ComplexVector& shape) {
  Eigen::Index most = 0;
  shape.cwiseAbs().maxCoeff(&most);
  return model.description().coordinate_names[static_cast<std::size_t>(most)];
}

/// "mode 3 (s = -0.1 + 2j, along y 1)", for every mode of a track.
std::string text_of(const Model& model, const Track& track) {
  std::ostringstream text;
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    const int mode = track.modes[static_cast<std::size_t>(i)];
    if (mode < 0) continue;
    const Complex s = chart_value(track.roots[i], track.pair.chart);
    text << (text.tellp() > 0 ? ", " : "") << "mode " << mode + 1 << " (s = " << s.real()
         << (s.imag() < 0.0 ? " - " : " + ") << std::abs(s.imag()) << "j, "
         << largest_motion(model, track.series.Z[0].col(i)) << ")";
  }
  return text.str();
}

/// The last pair of a track in the reduced coordinates of another point.
InvariantPair pair_at(const PathNode& node, const Track& track) {
  InvariantPair pair = track.pair;
  pair.factors.reset();
  const TangentBasis& basis = node.basis;
  if (basis.parts) {
    pair.Z = basis.coordinates(track.series.Z[0], pair.part);
  } else if (!basis.is_identity) {
    pair.Z = multiply(Matrix(basis.T[0].transpose()), track.series.Z[0]);
  }
  return pair;
}

/// Cosine of the largest angle between the spaces of two tracks, squared.
double resemblance(const ComplexMatrix& a, const ComplexMatrix& b) {
  const auto basis = [](const ComplexMatrix& Z) {
    const Eigen::HouseholderQR<ComplexMatrix> qr(Z);
    return ComplexMatrix(qr.householderQ() * ComplexMatrix::Identity(Z.rows(), std::min(Z.rows(), Z.cols())));
  };
  const ComplexMatrix overlap = basis(a).adjoint() * basis(b);
  const double cosine = singular_vectors(overlap).values.minCoeff();
  return cosine * cosine;
}

/// The ended track at this point; empty if it is not recognized there.
std::optional<Track> at_point(const PathProblem& problem, const PathNode& node, const Track& ended,
                              RunCounts& counts) {
  const InvariantPair start = pair_at(node, ended);
  const double reference = problem.reference(start.chart);
  const PencilAtPoint pencil(node.pencil.of(start.part), start.chart);
  InvariantPair pair = correct_pair(pencil, start, reference, problem.corrector, counts.modes);
  if (pair.status != PairStatus::converged) return std::nullopt;
  if (resemblance(pair.Z, start.Z) < problem.thresholds.identity.least_assurance) return std::nullopt;
  Track track = differentiate_track(problem, node, std::move(pair), counts);
  if (!track.functions.allFinite()) return std::nullopt;
  for (const Track& other : node.tracks) {
    if (have_common_eigenpair(track, other, reference, problem.thresholds.identity)) return std::nullopt;
  }
  track.roots = in_order_of(ended.roots, track.roots);
  track.modes = track.arriving = ended.modes;
  return track;
}

}  // namespace

std::string end_track(const PathProblem& problem, PathNode& node, std::size_t track,
                      std::vector<EndedTrack>& ended) {
  const auto place = node.tracks.begin() + static_cast<std::ptrdiff_t>(track);
  std::string text = text_of(problem.model, *place);
  ended.push_back({std::move(*place), 0});
  ended.back().track.departure.reset();
  ended.back().track.pair.factors.reset();
  node.tracks.erase(place);
  return text;
}

std::vector<std::string> find_again(const PathProblem& problem, PathNode& node,
                                    std::vector<EndedTrack>& ended, RunCounts& counts) {
  std::vector<std::string> found;
  if (ended.empty()) return found;
  const StageTimer timer(counts.matching_seconds);
  std::erase_if(ended, [&](EndedTrack& one) {
    if (auto track = at_point(problem, node, one.track, counts)) {
      found.push_back(text_of(problem.model, *track));
      node.tracks.push_back(std::move(*track));
      return true;
    }
    return ++one.looks >= most_looks;
  });
  return found;
}

}  // namespace eigentrail
