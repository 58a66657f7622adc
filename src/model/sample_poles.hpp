// Poles of sampled functions. Functions with poles near the range of the samples (resonances,
// compressibility, singular coordinates) make polynomials converge slowly. If q(x) vanishes at the poles, q f
// is smooth: it is interpolated instead of f, and the result divided by q. The poles are fitted to the
// samples: divided differences of q f vanish as far as q f is a polynomial, which is a linear problem for the
// coefficients of q (as in the linearized rational fit of Levy, IRE Trans. Automat. Contr. 4, 1959).
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Largest number of poles; complex ones come in pairs.
inline constexpr int most_poles = 2;
/// Most samples of a piece with poles. More samples resolve what is near the range without.
inline constexpr std::size_t most_samples_with_poles = 48;

/// q(x), positive on the range of the samples.
struct Denominator {
  /// Roots of q; one with an imaginary part, which is positive, stands for a conjugate pair.
  std::vector<Complex> poles = {};

  int degree() const;
  double operator()(double x) const;
};

/// R of the QR decomposition.
Matrix triangular_factor(const Matrix& matrix);

/// The denominator of degree `n_poles` with which `samples` (one column per node) are best a polynomial of
/// `degree`, divided by it. Empty if poles lie in the range of the nodes or too near, are too far to matter,
/// or if there are too few samples to tell. degree >= n_poles.
std::optional<Denominator> fitted_denominator(const std::vector<double>& nodes, const Matrix& samples,
                                              int degree, int n_poles);

}  // namespace eigentrail
