// Analytic functions of the whole spectrum at one parameter, and Chebyshev polynomials for them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "hard_cases/family.hpp"

namespace eigentrail::test {

/// A real number too large or small for a double: sign * exp(log).
struct Scaled {
  int sign = 0;
  double log = -std::numeric_limits<double>::infinity();

  void multiply(double factor) {
    sign *= factor > 0.0 ? 1 : factor < 0.0 ? -1 : 0;
    log += std::log(std::abs(factor));
  }
};

/// The functions of reference_events.hpp.
enum Function { det_K, F, D, n_functions };
struct AtParameter {
  std::vector<double> real;    ///< eigenvalues, ascending
  std::vector<Complex> upper;  ///< of the pairs, Im s > 0
  std::array<Scaled, n_functions> values;

  int unstable() const {
    const auto pairs = std::count_if(upper.begin(), upper.end(), [](Complex s) { return s.real() > 0.0; });
    const auto alone = std::count_if(real.begin(), real.end(), [](double s) { return s > 0.0; });
    return static_cast<int>(2 * pairs + alone);
  }

  /// Whether no real part is so small that rounding decides its sign.
  bool is_decided() const {
    constexpr double rounding = 1e-14;  // of the largest eigenvalue: some fifty units in the last place
    double largest = 0.0, least = std::numeric_limits<double>::infinity();
    const auto consider = [&](Complex s) {
      largest = std::max(largest, std::abs(s));
      least = std::min(least, std::abs(s.real()));
    };
    std::for_each(upper.begin(), upper.end(), consider);
    std::for_each(real.begin(), real.end(), consider);
    return least > rounding * largest;
  }
};

AtParameter spectrum_at(const Family& family, double p);

/// The Chebyshev series of a function on [-1, 1], divided by its largest value.
std::vector<double> chebyshev_coefficients(const std::function<Scaled(double)>& function, int degree);

/// Complex roots of a Chebyshev series.
std::vector<Complex> chebyshev_roots(std::vector<double> coefficients);

}  // namespace eigentrail::test
