#include "stability/extremum_walk.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "eigentrail/core/series.hpp"

namespace eigentrail {
namespace {

// Lengths are in the scaled window.
constexpr int most_steps = 40;
constexpr double smallest_radius = 1e-7;
constexpr int most_sections = 12;
constexpr double close_enough = 1e-6;  ///< close enough to the boundary for Newton's method

/// The Taylor polynomial of degree two of a function about a place.
template <class Value>
struct Quadratic {
  Value value{};
  std::array<Value, 2> gradient{};
  std::array<Value, 3> hessian{};  ///< second derivatives PP, PQ, QQ

  Value at(const Place& move) const {
    return value + gradient[0] * move[0] + gradient[1] * move[1] +
           0.5 * (hessian[0] * (move[0] * move[0]) + 2.0 * hessian[1] * (move[0] * move[1]) +
                  hessian[2] * (move[1] * move[1]));
  }
};

/// One mode at a place with its first and second derivatives.
struct Probe {
  Place place;
  EquilibriumGuess equilibrium;
  Matrix basis;
  Quadratic<Complex> s;
  Quadratic<double> w;  ///< its instability (line_scan.hpp)
};

/// The polynomial from series of second order along the directions (1, 0), (0, 1) and (1, 1).
template <class Value>
Quadratic<Value> quadratic(const std::array<Series<Value, 2>, 3>& along) {
  Quadratic<Value> model;
  model.value = along[0][0];
  model.gradient = {along[0][1], along[1][1]};
  model.hessian = {2.0 * along[0][2], along[2][2] - along[0][2] - along[1][2], 2.0 * along[1][2]};
  return model;
}

Series<double, 2> instability_series(const BoundaryOptions& options, const Series<Complex, 2>& s) {
  Series<double, 2> real, imaginary;
  for (int k = 0; k <= 2; ++k) {
    real[k] = s[k].real();
    imaginary[k] = s[k].imag();
  }
  if (!options.damping_ratio) return real;
  return real + *options.damping_ratio * sqrt(real * real + imaginary * imaginary);
}

/// Computes the mode whose eigenvalue is nearest to `expected`, with its derivatives; empty if that fails.
std::optional<Probe> probe(const Window& window, const BoundaryOptions& options, const Place& place,
                           Complex expected, const EquilibriumGuess& equilibrium, const Matrix& basis,
                           RunCounts& counts) {
  const PathProblem problem = window.at(place);
  Situation situation;
  situation.place = place;
  situation.point = reduce_at(problem, problem.parameters[problem.traced], equilibrium, basis, counts);
  if (situation.point.status != PointStatus::computed) return std::nullopt;
  situation.pencil = situation.point.pencil;
  const Spectrum spectrum =
      compute_spectrum(situation.pencil.M[0], situation.pencil.C[0], situation.pencil.K[0]);
  ++counts.spectra;
  if (spectrum.modes.empty()) return std::nullopt;
  const auto nearest = std::min_element(
      spectrum.modes.begin(), spectrum.modes.end(),
      [&](const auto& a, const auto& b) { return std::abs(a.s - expected) < std::abs(b.s - expected); });
  InvariantPair start;
  start.Z = nearest->z;
  start.Lambda = ComplexMatrix::Constant(1, 1, nearest->s);
  start.is_real = nearest->s.imag() == 0.0;
  if (start.is_real) start.Z.imag().setZero();
  situation.pair = correct_pair(PencilAtPoint(situation.pencil), start, window.reference(), problem.corrector,
                                counts.modes);
  if (situation.pair.status != PairStatus::converged) return std::nullopt;
  std::array<Series<Complex, 2>, 3> s;
  std::array<Series<double, 2>, 3> w;
  const std::array<Place, 3> directions{Place::Unit(0), Place::Unit(1), Place::Ones()};
  for (std::size_t i = 0; i < 3; ++i) {
    Matrix places(2, 2);
    places << place, directions[i];
    const auto series = differentiate_situation(window, situation, BoundaryFunction(), places, 2, counts);
    if (!series) return std::nullopt;
    for (int k = 0; k <= 2; ++k) s[i][k] = series->functions(0, k);
    w[i] = instability_series(options, s[i]);
  }
  return Probe{place, as_guess(situation, place).equilibrium, situation.point.basis.T[0], quadratic(s),
               quadratic(w)};
}

std::optional<Probe> probe_from(const Window& window, const BoundaryOptions& options, const Probe& base,
                                const Place& place, RunCounts& counts) {
  return probe(window, options, place, base.s.at(place - base.place), base.equilibrium, base.basis, counts);
}

/// Step of at most `radius` that increases sign * w: the Newton step with each eigenvalue of the Hessian
/// replaced by its magnitude, but at least |slope| / radius.
Place uphill(const Quadratic<double>& w, double sign, double radius) {
  Eigen::Matrix2d hessian;
  hessian << w.hessian[0], w.hessian[1], w.hessian[1], w.hessian[2];
  const Place slope = sign * Place(w.gradient[0], w.gradient[1]);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(hessian)};
  const Place components = solver.eigenvectors().transpose() * slope;
  const Place curvatures = solver.eigenvalues().cwiseAbs().cwiseMax(slope.norm() / radius);
  const Place step = solver.eigenvectors() * components.cwiseQuotient(curvatures.cwiseMax(1e-300));
  const double length = step.norm();
  return length > radius ? Place(radius / length * step) : step;
}

std::optional<BoundarySeed> seed_at(const Window& window, const BoundaryOptions& options,
                                    const Probe& there) {
  const Complex s = there.s.value;
  if (!passes_zero(options, s, window.reference())) return std::nullopt;
  return BoundarySeed{there.place, Place::Zero(), kind_of(options, s), s, there.equilibrium, true};
}

/// A seed between two probes with instabilities of opposite sign. The interval is divided by the secant or in
/// halves until it is short enough for Newton's method.
std::optional<BoundarySeed> seed_between(const Window& window, const BoundaryOptions& options, Probe a,
                                         Probe b, RunCounts& counts) {
  for (int i = 0; i < most_sections && (b.place - a.place).norm() > close_enough; ++i) {
    // Every third division is a halving: the secant alone may move one end only and converge slowly.
    const double share = i % 3 == 2 ? 0.5 : std::clamp(a.w.value / (a.w.value - b.w.value), 0.02, 0.98);
    const auto middle = probe_from(window, options, a, a.place + share * (b.place - a.place), counts);
    if (!middle) break;
    (middle->w.value * a.w.value > 0.0 ? a : b) = *middle;
  }
  return seed_at(window, options, std::abs(a.w.value) < std::abs(b.w.value) ? a : b);
}

}  // namespace

std::optional<BoundarySeed> walk_to_boundary(const Window& window, const BoundaryOptions& options,
                                             const LineExtremum& start, double radius, RunCounts& counts) {
  std::optional<Probe> here =
      probe(window, options, start.place, start.s, start.equilibrium, Matrix(), counts);
  if (here && here->w.value * start.sign >= 0.0) return seed_at(window, options, *here);
  const double longest = radius;
  for (int i = 0; here && i < most_steps && radius > smallest_radius; ++i) {
    const Place move = uphill(here->w, start.sign, radius);
    const Place target = (here->place + move).cwiseMax(0.0).cwiseMin(1.0);
    if (!((target - here->place).norm() > smallest_radius)) break;
    const auto there = probe_from(window, options, *here, target, counts);
    if (there && there->w.value * start.sign >= 0.0)
      return seed_between(window, options, *here, *there, counts);
    if (there && start.sign * (there->w.value - here->w.value) > 0.0) {
      here = there;
      radius = std::min(2.0 * radius, longest);
    } else {
      radius = 0.25 * std::min(radius, (target - here->place).norm());
    }
  }
  return std::nullopt;
}

}  // namespace eigentrail
