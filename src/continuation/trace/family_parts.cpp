#include "eigentrail/continuation/family_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// An eigenvalue is near the real axis if its imaginary part is below this share of its magnitude: a mode
/// that is damped nearly critically. With a smaller value an eigenvalue below the axis might be met; with a
/// larger one more pairs are followed as real parts, which costs time.
constexpr double near_axis = 1e-2;
/// The same as a share of the median magnitude, for eigenvalues that pass through zero.
constexpr double near_zero = 1e-3;

/// The ends of the range and some irregular places. An eigenvalue that is near the axis between them only is
/// noticed when the trace comes there.
std::vector<double> places_of(const TraceOptions& options) {
  constexpr int n_within = 3;
  std::vector<double> places{options.from, options.to};
  for (int i = 1; i <= n_within; ++i) {
    const double share = std::fmod(i / std::numbers::phi, 1.0);
    places.push_back(options.from + share * (options.to - options.from));
  }
  return places;
}

double median_magnitude(const std::vector<StartingMode>& by_magnitude) {
  return by_magnitude.empty() ? 0.0 : std::abs(by_magnitude[by_magnitude.size() / 2].s);
}

/// The number of modes of a complex part at a place; empty if one of them is near the real axis, or infinite
/// without being so by the form of the equations.
std::optional<std::size_t> modes_of_complex_part(const ReducedPencil& part) {
  const Spectrum spectrum = compute_eigenvalues(part);
  const Eigen::Index structural = part.size() - state_size(part.M[0]) / 2;
  if (spectrum.status != SpectrumStatus::complete || spectrum.n_infinite != (1 + part.copies) * structural)
    return std::nullopt;
  const double smallest = near_zero * median_magnitude(spectrum.modes);
  const bool apart =
      std::none_of(spectrum.modes.begin(), spectrum.modes.end(),
                   [&](const StartingMode& mode) { return is_near_real_axis(mode.s, smallest); });
  return apart ? std::optional(spectrum.modes.size()) : std::nullopt;
}

/// The pencil of a family at a place; empty if it cannot be computed.
std::optional<ReducedPencil> pencil_at(const PathProblem& problem, double p,
                                       const std::shared_ptr<const IndependentParts>& parts,
                                       EvaluationCounts& counts) {
  const Vector parameters = parameters_at(problem, p);
  Linearization there;
  if (problem.model.linearize({parameters, problem.model.initial_guess(parameters), Vector()}, 0, there,
                              counts))
    return std::nullopt;
  return reduce(there, basis_of(parts), 0);
}

/// For every part, whether it is half of a pair that has to be followed as one real part.
std::vector<bool> real_pairs(const PathProblem& problem, const TraceOptions& options,
                             const std::shared_ptr<const IndependentParts>& parts) {
  std::vector<bool> is_real(parts->count(), false);
  std::vector<std::size_t> modes(parts->count(), 0);
  EvaluationCounts counts = problem.model.new_counts();
  const std::vector<double> places = places_of(options);
  for (const double p : places) {
    const std::optional<ReducedPencil> pencil = pencil_at(problem, p, parts, counts);
    for (std::size_t i = 0; i < parts->count(); ++i) {
      if (parts->ranges[i].complex_sign == 0 || is_real[i]) continue;
      const auto count = pencil ? modes_of_complex_part(pencil->parts[i]) : std::nullopt;
      const bool passes_axis = p != places.front() && count && *count != modes[i];
      if (count) modes[i] = *count;
      if (count && !passes_axis) continue;
      is_real[i] = true;
      is_real[parts->ranges[i].complex_sign > 0 ? i + 1 : i - 1] = true;
    }
  }
  return is_real;
}

bool has_complex_parts(const IndependentParts* parts) {
  return parts != nullptr && std::any_of(parts->ranges.begin(), parts->ranges.end(),
                                         [](const auto& range) { return range.complex_sign != 0; });
}

}  // namespace

bool is_near_real_axis(Complex s, double smallest) {
  return !(std::abs(s.imag()) > std::max(near_axis * std::abs(s), smallest));
}

std::shared_ptr<const IndependentParts> parts_of_family(const PathProblem& problem,
                                                        const TraceOptions& options) {
  const CoefficientMatrices coefficients =
      problem.model.coefficient_matrices(problem.parameters, problem.traced);
  const std::shared_ptr<const IndependentParts> parts = find_independent_parts(coefficients);
  if (!problem.structure.fixed_equilibrium || problem.model.n_constraints() > 0) return parts;
  const auto pairs = find_conjugate_parts(coefficients, parts.get());
  if (!pairs) return parts;
  std::vector<int> numbers;
  auto chosen = joined_pairs(*pairs, real_pairs(problem, options, pairs), numbers);
  return has_complex_parts(chosen.get()) ? chosen : parts;
}

}  // namespace eigentrail
