#include <algorithm>
#include <cmath>
#include <numeric>

#include "accuracy/grid_loci.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// The whole spectrum at a point, with both members of complex pairs.
struct GridPoint {
  ComplexVector s;
  ComplexMatrix shapes;  ///< columns: mode shapes in physical coordinates, v = T z
  SystemMatrix mass;     ///< mass matrix, the weight of the modal assurance criterion
};

GridPoint members_of(const Spectrum& spectrum, const PathPoint& point) {
  std::vector<Complex> s;
  std::vector<ComplexVector> shapes;
  for (const StartingMode& mode : spectrum.modes) {
    const ComplexVector v = point.basis.T[0].cast<Complex>() * mode.z;
    s.push_back(mode.s);
    shapes.push_back(v);
    if (mode.s.imag() == 0.0) continue;
    s.push_back(std::conj(mode.s));
    shapes.push_back(v.conjugate());
  }
  const auto count = static_cast<Eigen::Index>(s.size());
  GridPoint result{ComplexVector(count), ComplexMatrix(point.basis.T[0].rows(), count),
                   point.equilibrium.linearization.M[0]};
  for (Eigen::Index i = 0; i < count; ++i) {
    result.s[i] = s[static_cast<std::size_t>(i)];
    result.shapes.col(i) = shapes[static_cast<std::size_t>(i)];
  }
  return result;
}

/// Brings the chosen modes to the front, and returns the number of their eigenvalues, both members of complex
/// pairs counted. members_of keeps them first.
Eigen::Index choose_members(const ModeChoice& modes, Spectrum& spectrum) {
  const auto end = spectrum.modes.begin() + choose_modes(modes, spectrum.modes);
  return std::accumulate(
      spectrum.modes.begin(), end, Eigen::Index{0},
      [](Eigen::Index count, const StartingMode& mode) { return count + (mode.s.imag() == 0.0 ? 1 : 2); });
}

/// Cost of matching modes: 1 - MAC, with the modal assurance criterion MAC. An eigenvalue above the real axis
/// is not matched with one below: the conjugate of backward whirl has the same shape as forward whirl.
Matrix disagreement(const GridPoint& last, const GridPoint& next) {
  Matrix cost = 1.0 - modal_assurance(last.shapes, next.shapes, next.mass).array();
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      if (last.s[i].imag() * next.s[j].imag() < 0.0) cost(i, j) += 10.0;  // 1 - MAC is at most 1
      if (!std::isfinite(cost(i, j))) cost(i, j) = 1.0;
    }
  }
  return cost;
}

/// The point `next` with its modes in the order of those of `last`.
GridPoint in_order(const GridPoint& last, const GridPoint& next) {
  const std::vector<int> successor = optimal_assignment(disagreement(last, next));
  GridPoint result = next;
  for (Eigen::Index i = 0; i < next.s.size(); ++i) {
    result.s[i] = next.s[successor[static_cast<std::size_t>(i)]];
    result.shapes.col(i) = next.shapes.col(successor[static_cast<std::size_t>(i)]);
  }
  return result;
}

}  // namespace

GridLoci qz_grid(const PathProblem& problem, const std::vector<double>& p, const ModeChoice& modes) {
  GridLoci loci;
  Eigen::Index followed = 0;
  loci.both_members = true;
  EquilibriumGuess guess{problem.model.initial_guess(parameters_at(problem, p.front())), {}, false};
  GridPoint last;
  for (const double value : p) {
    const PathPoint point = reduce_at(problem, value, guess, Matrix(), loci.counts);
    loci.message = point.message;
    if (point.status != PointStatus::computed) return loci;
    guess = {point.equilibrium.x, point.equilibrium.lambda, true};
    Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
    ++loci.counts.spectra;
    loci.message = "QZ did not yield a spectrum";
    if (spectrum.status != SpectrumStatus::complete) return loci;
    if (loci.p.empty()) followed = choose_members(modes, spectrum);
    GridPoint next = members_of(spectrum, point);
    loci.message = "the number of finite eigenvalues changes";
    if (!loci.p.empty() && next.s.size() != last.s.size()) return loci;
    last = loci.p.empty() ? std::move(next) : in_order(last, next);
    loci.p.push_back(value);
    loci.s.emplace_back(last.s.head(followed));
  }
  loci.message.clear();
  loci.completed = true;
  return loci;
}

}  // namespace eigentrail
