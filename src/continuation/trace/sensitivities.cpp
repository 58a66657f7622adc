#include "eigentrail/continuation/sensitivities.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/singular_vectors.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// Relative size below which a quantity counts as zero:
///  - singular values of P(s) = s^2 M + s C + K relative to |s|^2 |M| + |s| |C| + |K|: their vectors span the
///  kernel;
///  - the determinant of Y* P'(s) Z, of the kernel's vectors, relative to |P'(s)|: s is defective;
///  - how much the derivatives of the members of a semisimple eigenvalue differ, relative to their size: the
///  members
///    separate with the parameter, and none of them has a derivative of its own.
/// It is the square root of rounding, the accuracy of a double eigenvalue. With a larger value close but
/// different eigenvalues are taken for one, with a smaller one the derivative may be dominated by rounding.
constexpr double multiple = 1e-8;
/// For the third of these: the derivative of the vectors of a kernel is known to that root only.
constexpr double alike = 1e-6;

/// An eigenvalue with the vectors of its kernel.
struct ModeVectors {
  Complex s;
  ComplexMatrix right, left;  ///< n x m
  ComplexMatrix slope;        ///< Y* P'(s) Z, m x m
  double magnitude;           ///< |P'(s)| (Frobenius), the scale of the slope
};

ModeVectors vectors_of(const ReducedPencil& pencil, Complex s) {
  const ComplexMatrix P = s * s * pencil.M[0] + s * pencil.C[0] + pencil.K[0];
  const ComplexMatrix derivative = 2.0 * s * pencil.M[0] + pencil.C[0].cast<Complex>();
  const double scale =
      std::norm(s) * pencil.M[0].norm() + std::abs(s) * pencil.C[0].norm() + pencil.K[0].norm();
  const SingularVectors<ComplexMatrix> svd = singular_vectors(P);
  const Eigen::Index m = std::max<Eigen::Index>(1, (svd.values.array() <= multiple * scale).count());
  const ComplexMatrix Z = svd.V.rightCols(m), Y = svd.U.rightCols(m);
  return {s, Z, Y, Y.adjoint() * derivative * Z, derivative.norm()};
}

/// ds/de = -y* (s^2 M_e + s C_e + K_e) z / (y* P'(s) z) from the coefficients of order 1 of the pencil's
/// series in e; of a semisimple eigenvalue, that of all its members. NaN where the eigenvalue is defective or
/// they separate.
Complex derivative(const ModeVectors& mode, const ReducedPencil& pencil) {
  const auto along = [](const MatrixSeries& series, Eigen::Index n) -> Matrix {
    return series.size() > 1 ? series[1] : Matrix(Matrix::Zero(n, n));
  };
  const Eigen::Index m = mode.slope.rows(), n = pencil.size();
  const Eigen::FullPivLU<ComplexMatrix> slope(mode.slope);
  if (!(std::abs(slope.determinant()) > multiple * std::pow(mode.magnitude, m))) return {NAN, NAN};
  const ComplexMatrix change =
      mode.s * mode.s * along(pencil.M, n) + mode.s * along(pencil.C, n) + along(pencil.K, n);
  const ComplexMatrix of_members = -slope.solve(mode.left.adjoint() * change * mode.right);
  const Complex mean = of_members.trace() / static_cast<double>(m);
  const double difference = (of_members - mean * ComplexMatrix::Identity(m, m)).norm();
  return m > 1 && difference > alike * of_members.norm() ? Complex(NAN, NAN) : mean;
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
