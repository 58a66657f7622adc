// One freedom s^2 + c(p) s + k(p) = 0 with polynomials c and k, stopped between two points.
#pragma once

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test {

/// Value of a polynomial, coefficients by ascending powers.
inline double value_of(const std::vector<double>& coefficients, double p) {
  double value = 0.0;
  for (std::size_t i = coefficients.size(); i > 0; --i) value = value * p + coefficients[i - 1];
  return value;
}

/// Keeps references to itself.
struct PlantedOscillator : PlantedSearch {
  PlantedOscillator(std::vector<double> damping, std::vector<double> stiffness, int order = 4)
      : PlantedSearch(Planted({{Matrix{{1.0}}}, as_matrices(damping), as_matrices(stiffness)}, order)),
        c(std::move(damping)),
        k(std::move(stiffness)) {}

  static std::vector<Matrix> as_matrices(const std::vector<double>& coefficients) {
    std::vector<Matrix> matrices;
    for (const double coefficient : coefficients) matrices.emplace_back(Matrix{{coefficient}});
    return matrices;
  }

  /// The eigenvalue with Im s > 0, or the larger one of two real ones.
  Complex root(double p) const {
    const double half = 0.5 * value_of(c, p);
    const double square = half * half - value_of(k, p);
    return square < 0.0 ? Complex(-half, std::sqrt(-square)) : Complex(-half + std::sqrt(square));
  }

  /// A step with this eigenvalue as a single mode.
  Step single(double from, double to, Chart chart = Chart::finite) {
    left = family.point(from, {{{root(from)}, chart}});
    return step(left, to, {{{root(to)}, chart}});
  }

  std::vector<double> c, k;
  PathNode left;
};

}  // namespace eigentrail::test
