#include "continuation/planted_points.hpp"

#include <algorithm>
#include <stdexcept>

#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail::test {
namespace {

/// A scene must use its parameter. The term zero times p does this.
FamilyMatrices with_variable(FamilyMatrices matrices) {
  if (matrices.K.size() == 1)
    matrices.K.emplace_back(Matrix::Zero(matrices.K[0].rows(), matrices.K[0].cols()));
  return matrices;
}

bool is_closed_under_conjugation(const std::vector<Complex>& s) {
  return std::all_of(s.begin(), s.end(), [&](Complex a) {
    return std::any_of(s.begin(), s.end(), [&](Complex b) { return std::abs(a - std::conj(b)) < 1e-12; });
  });
}

ComplexVector in_chart(const Together& track) {
  ComplexVector mu(static_cast<Eigen::Index>(track.s.size()));
  for (std::size_t i = 0; i < track.s.size(); ++i)
    mu[static_cast<Eigen::Index>(i)] = chart_value(track.s[i], track.chart);
  return mu;
}

}  // namespace

Planted::Planted(const FamilyMatrices& matrices, int order)
    : setting_(
          make_setting(family_scene(with_variable(matrices), -1.0, 1.0), {{"order", std::to_string(order)}})),
      problem_(setting_.problem()) {
  problem_.s_ref = 1e-3;
  problem_.s_max = 1e6;
}

Planted Planted::frequencies(const std::vector<Matrix>& W, int order) {
  const Eigen::Index n = W[0].rows();
  std::vector<Matrix> K(2 * W.size() - 1, Matrix::Zero(n, n));
  for (std::size_t a = 0; a < W.size(); ++a) {
    for (std::size_t b = 0; b < W.size(); ++b) K[a + b] += W[a] * W[b];
  }
  return Planted({{Matrix::Identity(n, n)}, {}, K}, order);
}

PathPoint Planted::reduced(double p, const Matrix& previous_basis) {
  const Vector guess = model().initial_guess(parameters_at(problem_, p));
  PathPoint point = reduce_at(problem_, p, {guess, Vector()}, previous_basis, counts);
  if (point.status != PointStatus::computed) throw std::runtime_error(point.message);
  return point;
}

InvariantPair Planted::pair_of(const PathPoint& point, const Together& track) {
  const ComplexVector roots = in_chart(track);
  ReducedPencil pencil = point.pencil;
  if (track.chart == Chart::reciprocal) std::swap(pencil.M, pencil.K);
  const bool is_real = is_closed_under_conjugation(track.s);
  InvariantPair start =
      invariant_subspace(pencil.M[0], pencil.C[0], pencil.K[0],
                         is_real ? Complex(roots.mean().real()) : roots.mean(), roots.size(), is_real);
  start.chart = track.chart;
  InvariantPair pair = correct_pair(PencilAtPoint(point.pencil, track.chart), start,
                                    problem_.reference(track.chart), problem_.corrector, counts.modes);
  if (pair.status != PairStatus::converged) throw std::runtime_error("a planted track did not converge");
  return pair;
}

PathNode Planted::point(double p, const std::vector<Together>& tracks, const Matrix& previous_basis) {
  // A defective double eigenvalue is known to the square root of rounding, a triple one to the cube root.
  constexpr double told = 1e-4;
  PathPoint point = reduced(p, previous_basis);
  for (const Together& track : tracks) point.pairs.push_back(pair_of(point, track));
  auto node = differentiate_point(problem_, point, counts);
  if (!node) throw std::runtime_error("a planted series is not finite");
  int mode = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Track& track = node->tracks[i];
    const ComplexVector expected = in_chart(tracks[i]);
    track.roots = in_order_of(expected, track.roots);
    if ((track.roots - expected).norm() > told * std::max(expected.norm(), 1e-3))
      throw std::runtime_error("a planted eigenvalue is none of the family");
    for (std::size_t k = 0; k < tracks[i].s.size(); ++k) {
      const bool lower = track.pair.is_real && tracks[i].s[k].imag() < 0.0;
      track.modes[k] = lower ? Track::no_mode : mode++;
    }
    track.arriving = track.modes;
  }
  return std::move(*node);
}

std::vector<Together> alone(const std::vector<Complex>& s) {
  std::vector<Together> tracks;
  for (const Complex one : s) tracks.push_back({{one}});
  return tracks;
}

double distance(const ComplexVector& a, const ComplexVector& b) {
  ComplexVector difference = ComplexVector::Zero(std::max(a.size(), b.size()));
  difference.head(a.size()) += a;
  difference.head(b.size()) -= b;
  return difference.cwiseAbs().maxCoeff();
}

std::vector<Matrix> uncoupled(const Matrix& coefficients) {
  std::vector<Matrix> W;
  for (Eigen::Index k = 0; k < coefficients.cols(); ++k)
    W.emplace_back(Vector(coefficients.col(k)).asDiagonal());
  return W;
}

}  // namespace eigentrail::test
