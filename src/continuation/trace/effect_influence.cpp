#include "eigentrail/continuation/effect_influence.hpp"
#include "core/singular_vectors.hpp"

#include <algorithm>
#include <limits>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// Relative size below which a quantity counts as zero, so that an eigenvalue s of P(s) = s^2 M + s C + K is
/// multiple and has no derivative:
///  - y* P'(s) z relative to |P'(s)|, with unit eigenvectors z and y: s is defective;
///  - the second smallest singular value of P(s) relative to the largest one: s is semisimple, and its
///    eigenvectors are not unique.
/// It is the square root of rounding, the accuracy of a double eigenvalue. With a larger value close but
/// different eigenvalues get no derivative, with a smaller one the derivative may be dominated by rounding.
constexpr double multiple = 1e-8;

/// An eigenvalue with its right and left eigenvector.
struct ModeVectors {
  Complex s;
  ComplexVector right, left;
  Complex denominator;  ///< y* P'(s) z
  double magnitude;     ///< |P'(s)| (Frobenius), the scale of the denominator
  bool is_simple;       ///< the kernel of P(s) has one dimension
};

ModeVectors vectors_of(const ReducedPencil& pencil, Complex s) {
  const ComplexMatrix P = s * s * pencil.M[0] + s * pencil.C[0] + pencil.K[0];
  const ComplexMatrix derivative = 2.0 * s * pencil.M[0] + pencil.C[0].cast<Complex>();
  const SingularVectors<ComplexMatrix> svd = singular_vectors(P);
  const Eigen::Index last = P.cols() - 1;
  const ComplexVector z = svd.V.col(last);
  const ComplexVector y = svd.U.col(last);
  const bool is_simple = last == 0 || svd.values[last - 1] > multiple * svd.values[0];
  return {s, z, y, y.dot(derivative * z), derivative.norm(), is_simple};
}

/// ds/de = -y* (s^2 M_e + s C_e + K_e) z / (y* P'(s) z) from the coefficients of order 1 of the pencil's
/// series in e; NaN at a multiple eigenvalue.
Complex derivative(const ModeVectors& mode, const ReducedPencil& pencil) {
  const auto along = [](const MatrixSeries& series, Eigen::Index n) -> Matrix {
    return series.size() > 1 ? series[1] : Matrix(Matrix::Zero(n, n));
  };
  if (!mode.is_simple || !(std::abs(mode.denominator) > multiple * mode.magnitude))
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Index n = pencil.size();
  const ComplexMatrix change =
      mode.s * mode.s * along(pencil.M, n) + mode.s * along(pencil.C, n) + along(pencil.K, n);
  return -mode.left.dot(change * mode.right) / mode.denominator;
}

}  // namespace

Influences effect_influences(const TraceSetup& setup) {
  Influences result;
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.order = 1;
  RunCounts counts;
  const double from = setup.options.from;
  const Vector guess = setup.model->initial_guess(parameters_at(problem, from));
  PathPoint point = reduce_at(problem, from, {guess, Vector()}, Matrix(), counts);
  if (point.status != PointStatus::computed) {
    result.fault = point.message;
    return result;
  }
  Spectrum spectrum = compute_eigenvalues(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete || spectrum.modes.empty()) {
    result.fault = "there are no modes where the trace begins";
    return result;
  }
  std::vector<ModeVectors> modes;
  const int chosen = choose_modes(setup.options.modes, spectrum.modes);
  for (int i = 0; i < chosen; ++i)
    modes.push_back(vectors_of(point.pencil, spectrum.modes[static_cast<std::size_t>(i)].s));
  result.s.resize(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) result.s[static_cast<Eigen::Index>(i)] = modes[i].s;
  const Parameters& parameters = setup.model->description().parameters;
  for (const Effect& effect : setup.model->description().effects) {
    const auto strength = parameters.index(strength_parameter(effect.name));
    if (!strength) continue;
    const auto node = differentiate_point(problem, point, *strength, counts);
    if (!node) {
      result.fault =
          "the derivative with respect to the " + strength_parameter(effect.name) + " is not finite";
      return result;
    }
    EffectInfluence influence{effect.name, ComplexVector(result.s.size())};
    for (std::size_t i = 0; i < modes.size(); ++i)
      influence.derivatives[static_cast<Eigen::Index>(i)] = derivative(modes[i], node->pencil);
    result.effects.push_back(std::move(influence));
  }
  return result;
}

}  // namespace eigentrail
