#include "eigentrail/continuation/sensitivities.hpp"

#include <algorithm>
#include <limits>

#include "core/singular_vectors.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/core/text.hpp"
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

std::vector<int> free_parameters(const Parameters& parameters) {
  std::vector<int> free;
  for (std::size_t q = 0; q < parameters.size(); ++q) {
    if (!parameters[q].definition) free.push_back(static_cast<int>(q));
  }
  return free;
}

Sensitivities sensitivities_at(const TraceSetup& setup, double p, const std::vector<int>& parameters,
                               const Vector& guess) {
  Sensitivities result;
  const auto failed = [&result](const std::string& fault) {
    result.fault = fault;
    return result;
  };
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.order = 1;
  RunCounts counts;
  const Vector x = guess.size() > 0 ? guess : setup.model->initial_guess(parameters_at(problem, p));
  const PathPoint point = reduce_at(problem, p, {x, Vector()}, Matrix(), counts);
  if (point.status != PointStatus::computed) return failed(point.message);
  Spectrum spectrum = compute_eigenvalues(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete || spectrum.modes.empty())
    return failed("there are no modes at " + setup.options.parameter + " = " + exact_text(p));
  const int chosen = choose_modes(setup.options.modes, spectrum.modes);
  result.s.resize(chosen);
  for (int i = 0; i < chosen; ++i) result.s[i] = spectrum.modes[static_cast<std::size_t>(i)].s;
  std::vector<ModeVectors> modes;
  for (const Complex s : result.s) modes.push_back(vectors_of(point.pencil, s));
  result.parameters = parameters;
  result.derivatives.resize(chosen, static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t q = 0; q < parameters.size(); ++q) {
    const auto node = differentiate_point(problem, point, parameters[q], counts);
    if (!node) {
      const auto& name = setup.model->description().parameters[static_cast<std::size_t>(parameters[q])].name;
      return failed("the derivative with respect to the " + name + " is not finite");
    }
    for (int i = 0; i < chosen; ++i)
      result.derivatives(i, static_cast<Eigen::Index>(q)) =
          derivative(modes[static_cast<std::size_t>(i)], node->pencil);
  }
  return result;
}

Influences effect_influences(const TraceSetup& setup) {
  const Parameters& parameters = setup.model->description().parameters;
  std::vector<int> strengths;
  std::vector<std::string> names;
  for (const Effect& effect : setup.model->description().effects) {
    const auto strength = parameters.index(strength_parameter(effect.name));
    if (!strength) continue;
    strengths.push_back(*strength);
    names.push_back(effect.name);
  }
  const Sensitivities found = sensitivities_at(setup, setup.options.from, strengths);
  Influences result{found.fault, found.s, {}};
  if (!found.fault.empty()) return result;
  for (std::size_t q = 0; q < names.size(); ++q)
    result.effects.push_back({names[q], found.derivatives.col(static_cast<Eigen::Index>(q))});
  return result;
}

}  // namespace eigentrail
